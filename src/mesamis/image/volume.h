// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "mesamis/base/types.h"

namespace mesamis {

/// A regular grid of voxels and its place in the world: a scan without its samples.
///
/// World frame: LPS (x to the patient's left, y to the back, z to the head), in mm.
/// World position of voxel (i, j, k): origin + direction * (i sx, j sy, k sz).
struct VoxelGrid {
  std::array<Index, 3> size{0, 0, 0};  ///< voxels along i, j, k
  Vec3 spacing{1, 1, 1};               ///< mm between voxel centres, positive
  Vec3 origin{0, 0, 0};                ///< LPS position of voxel (0, 0, 0), mm
  Mat3 direction{};                    ///< orthonormal; column k is the LPS direction of axis k.
                                       ///< Its determinant may be -1: a left-handed grid
  std::string modality{};              ///< "CT", "MR", ... as the file says; empty: unknown
  std::string frame_of_reference{};    ///< its UID in DICOM; empty: the file states none

  /// The number of voxels.
  std::size_t voxel_count() const noexcept {
    return static_cast<std::size_t>(size[0]) * static_cast<std::size_t>(size[1]) *
           static_cast<std::size_t>(size[2]);
  }
  /// The place of voxel (i, j, k) among the samples: i runs fastest, then j, k.
  std::size_t offset(Index i, Index j, Index k) const noexcept {
    return (static_cast<std::size_t>(k) * static_cast<std::size_t>(size[1]) +
            static_cast<std::size_t>(j)) *
               static_cast<std::size_t>(size[0]) +
           static_cast<std::size_t>(i);
  }
  /// The voxel (i, j, k) at a place among the samples: the other way round.
  std::array<Index, 3> voxel(std::size_t place) const noexcept { return grid_place(size, place); }

  /// The box spanned by the voxel centres, in the grid's own axes, mm: [0, (n-1) s] per direction.
  Box box() const noexcept {
    return {{0, 0, 0},
            {(size[0] - 1) * spacing.x, (size[1] - 1) * spacing.y, (size[2] - 1) * spacing.z}};
  }
  /// The volume of a voxel, mm^3.
  double voxel_volume() const noexcept { return spacing.x * spacing.y * spacing.z; }
  /// The geometric mean of the spacing, mm.
  double voxel_size() const noexcept { return std::cbrt(voxel_volume()); }
  /// The shortest side of a voxel, mm.
  double shortest_side() const noexcept { return std::min({spacing.x, spacing.y, spacing.z}); }
  /// The longest one.
  double longest_side() const noexcept { return std::max({spacing.x, spacing.y, spacing.z}); }
  /// From the grid's own axes (mm) to the world (LPS, mm).
  Vec3 to_world(const Vec3& p) const noexcept { return origin + direction * p; }
  /// From the world (LPS, mm) to the grid's own axes (mm).
  Vec3 to_grid(const Vec3& p) const noexcept { return transpose(direction) * (p - origin); }
};

/// A scan whose samples are owned elsewhere. Functions that only read a scan take a view, so voxels
/// in memory need no copy:
///
///   mes_amis(VolumeView{{.size = {nx, ny, nz}, .spacing = {0.5, 0.5, 1}}, voxels}, settings);
///
/// The view does not own the samples: they must live, unchanged, as long as it is used. No function
/// of this library keeps a view after it has returned.
struct VolumeView : VoxelGrid {
  std::span<const float> samples;  ///< native units (HU, counts); i runs fastest, then j, k

  /// The sample of voxel (i, j, k), native units; the voxel must be within the grid.
  float at(Index i, Index j, Index k) const noexcept { return samples[offset(i, j, k)]; }
};

/// A scan: one sample per voxel centre of a regular grid, and where the grid lies in the world.
struct Volume : VoxelGrid {
  std::vector<float> samples;  ///< native units (HU, counts); i runs fastest, then j, k

  /// The sample of voxel (i, j, k), native units; the voxel must be within the grid.
  float at(Index i, Index j, Index k) const noexcept { return samples[offset(i, j, k)]; }
  /// The volume as a view, valid until the volume is changed or destroyed.
  operator VolumeView() const { return {*this, samples}; }  // NOLINT(google-explicit-constructor)
};

/// Copies a scan; the copy owns its samples.
Volume copy_volume(const VolumeView& volume);

/// Checks that a volume can be processed: at least 2 voxels per direction, as many samples as
/// voxels, positive finite spacing, finite origin, orthonormal direction (to 1e-6), finite samples
/// that are not all equal. Readers return volumes that fail here (a single slice of a 3D format,
/// NaN): check before any method.
/// @throws InputError  naming the first condition that does not hold.
void require_usable(const VolumeView& volume);

/// A range of values, native units.
struct Window {
  double low, high;
};

/// Half-open voxel ranges [begin, end) per direction; an end of -1 means the volume's.
struct CropRange {
  std::array<Index, 3> begin{0, 0, 0};
  std::array<Index, 3> end{-1, -1, -1};
  friend bool operator==(const CropRange&, const CropRange&) = default;
};

/// Counts the voxels of the volume that the range keeps along each axis.
/// @throws InputError  if the volume has fewer than 2 voxels along an axis, or the range leaves it
///                     or keeps fewer.
std::array<Index, 3> cropped_size(const VoxelGrid& volume, const CropRange& range);

/// Copies the part of the volume inside the range; its world position is kept.
/// @throws InputError  as cropped_size().
/// O(voxels kept).
Volume crop(const VolumeView& volume, const CropRange& range);

/// Copies the marks inside the range.
/// @param marks  one per voxel of the grid; i runs fastest, then j, k.
/// @return in the same order.
/// @throws InputError  as cropped_size().
/// O(voxels kept).
std::vector<std::uint8_t> crop(std::span<const std::uint8_t> marks, const VoxelGrid& grid,
                               const CropRange& range);

/// Keeps every stride-th voxel, starting with the first; world positions are kept.
/// @param stride  voxels along each axis, >= 1.
/// @throws InputError  if a stride is below 1 or leaves fewer than 2 voxels in a direction.
/// O(voxels kept).
Volume subsample(const VolumeView& volume, const std::array<Index, 3>& stride);

/// Values on a regular grid as a continuous function: linear on each of the six Kuhn tetrahedra of
/// a grid cell, equal to the values at the nodes. It is the piecewise linear function of a mesh
/// made by kuhn_cell on the grid, found without the mesh: from the cell's lowest corner walk along
/// the axes, the largest fraction first, and weigh the four corners met.
///
/// This is the function along one line in the direction of i: what depends on j and k alone is
/// computed once.
template <class Number>
class GridLine {
 public:
  /// Finds the four rows of nodes around a line.
  /// @param values  one per node, any unit; i runs fastest, then j, k. They must live longer than
  ///                this.
  /// @param size    nodes along i, j, k; at least 2 each.
  /// @param y, z    of the line, in steps of the grid; clamped to it.
  GridLine(std::span<const Number> values, const std::array<Index, 3>& size, double y, double z)
      : size_(size[0]) {
    assert(std::min({size[0], size[1], size[2]}) >= 2);
    const Place in_y(y, size[1]), in_z(z, size[2]);
    const auto step_y = static_cast<std::ptrdiff_t>(size[0]);
    const std::ptrdiff_t step_z = step_y * size[1];
    const bool y_first = in_y.fraction >= in_z.fraction;
    more_ = y_first ? in_y.fraction : in_z.fraction;
    less_ = y_first ? in_z.fraction : in_y.fraction;
    row_ = values.data() + step_y * in_y.cell + step_z * in_z.cell;
    first_ = row_ + (y_first ? step_y : step_z);
    both_ = row_ + step_y + step_z;
  }

  /// The value at a point of the line, in the unit of the nodes' values.
  /// @param x  in steps of the grid; clamped to it.
  double at(double x) const noexcept {
    const Place in_x(x, size_);
    const Index i = in_x.cell;
    const double fraction = in_x.fraction;
    if (fraction >= more_) {
      return walk({row_[i], row_[i + 1], first_[i + 1], both_[i + 1]}, {fraction, more_, less_});
    }
    if (fraction >= less_) {
      return walk({row_[i], first_[i], first_[i + 1], both_[i + 1]}, {more_, fraction, less_});
    }
    return walk({row_[i], first_[i], both_[i], both_[i + 1]}, {more_, less_, fraction});
  }

 private:
  struct Place {
    Place(double x, Index size) {
      const double inside = x > 0 ? std::min<double>(x, size - 1) : 0;  // NaN goes to 0
      cell = std::min(static_cast<Index>(inside), size - 2);
      fraction = inside - cell;
    }
    Index cell;
    double fraction;
  };

  static double walk(const std::array<double, 4>& f, const std::array<double, 3>& fractions) {
    return f[0] + fractions[0] * (f[1] - f[0]) + fractions[1] * (f[2] - f[1]) +
           fractions[2] * (f[3] - f[2]);
  }

  Index size_;
  double more_, less_;                  // of the fractions along j and k
  const Number *row_, *first_, *both_;  // after the step of the greater fraction, and after both
};

/// Evaluates that function at one point.
/// @param values, size  as for GridLine.
/// @param spacing  between nodes, > 0.
/// @param p        in the grid's own axes, in the unit of the spacing; clamped to the box.
/// @return in the unit of the values.
template <class Number>
double interpolate(std::span<const Number> values, const std::array<Index, 3>& size,
                   const Vec3& spacing, const Vec3& p) {
  return GridLine<Number>(values, size, p.y / spacing.y, p.z / spacing.z).at(p.x / spacing.x);
}

/// Evaluates the image as a continuous function (GridLine) at one point.
/// @param volume  at least 2 voxels along each axis. For many points pass a view: each conversion of a Volume copies its grid.
/// @param p  in the grid's own axes, mm; clamped to the box.
/// @return in the unit of the samples.
inline double interpolate(const VolumeView& volume, const Vec3& p) {
  return interpolate(volume.samples, volume.size, volume.spacing, p);
}

}  // namespace mesamis
