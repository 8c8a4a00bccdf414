// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "mesamis/image/slice_source.h"
#include "mesamis/image/volume.h"

/// Phantoms: synthetic scans whose surface is known. Each is an implicit function, sampled.
namespace mesamis::detail::phantom {

/// One of the phantoms.
struct PhantomInfo {
  std::string name, description;
  std::array<Index, 3> size;  ///< voxels of 1 mm that it is designed for
};

/// Lists all phantoms, in the order in which they are documented. O(1) time and memory.
std::vector<PhantomInfo> phantom_list();

/// An object in the box [0, size * spacing] of the world (mm). The object is designed for the box
/// of its default size at 1 mm; it is scaled, alike in all directions, by the largest factor with
/// which that box fits into this one, and put in the middle. So the shape depends on the box alone,
/// not on its voxels.
struct Phantom {
  std::string name;
  std::array<Index, 3> size{0, 0, 0};
  Vec3 spacing{1, 1, 1};  ///< mm
  double scale = 1;
  /// Positive inside, zero on the surface, near the surface about the distance from it, mm.
  /// 1-Lipschitz. Near the surface the gradient is continuous and its norm at least 0.2: edges are
  /// rounded.
  std::function<double(const Vec3&)> inside;
  /// Grey value at a point of the object, where `inside` is the given depth.
  std::function<double(const Vec3& p, double depth)> grey;
  double constant_below = 0;  ///< deeper than this the grey value is constant, mm; may be infinite
  double background = 120;    ///< grey value outside
  /// Planes x, y, z = const, ascending, of a grid that is fine enough to tell the object's parts
  /// from each other; from the box's low to its high end.
  std::array<std::vector<double>, 3> lines;
};

/// Voxels per direction that a phantom needs at least.
inline constexpr Index kPhantomSizeMin = 8;

/// Makes a phantom in a box.
/// @param name     one of phantom_list().
/// @param size     kPhantomSizeMin to 4096 voxels each; {0, 0, 0}: its own.
/// @param spacing  mm, positive.
/// @throws InputError  for anything else.
/// O(1); nothing is sampled yet.
Phantom make_phantom(std::string_view name, const std::array<Index, 3>& size = {0, 0, 0},
                     const Vec3& spacing = {1, 1, 1});

/// Samples a phantom: each voxel that the surface may cross (or that lies in an object whose grey
/// value varies) is the mean of samples^3 points; elsewhere one point is enough. Voxel (0, 0, 0)
/// has its centre at half the spacing; the axes are those of the world.
/// @param samples  points per voxel and axis, 1 to 16.
/// @return grey values. The same bits for any number of threads.
/// @throws InputError  if samples is out of range, or there are 2^31 voxels or more: see
///                     PhantomSlices.
/// O(voxels), and samples^3 per voxel at the surface.
Volume sample_phantom(const Phantom& phantom, int samples = 4);

/// A phantom that is sampled a few slices at a time, for volumes larger than the memory: to the bit
/// the slices of sample_phantom().
class PhantomSlices : public SliceSource {
 public:
  /// @param samples  points per voxel and axis, 1 to 16.
  /// @throws InputError  if samples is out of range.
  explicit PhantomSlices(Phantom phantom, int samples = 4);
  const VoxelGrid& grid() const override { return grid_; }
  std::vector<float> read(Index first, Index count) const override;

 private:
  Phantom phantom_;
  int samples_;
  VoxelGrid grid_;
};

}  // namespace mesamis::detail::phantom
