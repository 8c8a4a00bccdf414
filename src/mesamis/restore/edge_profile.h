// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "mesamis/restore/level_crossings.h"

/// The image along the normals of an object's surface, and the edge that explains it.
namespace mesamis::detail::restore {

inline constexpr int kProfileHalf = 12;       // samples on either side of the surface
inline constexpr double kProfileStep = 0.25;  // voxels
/// Fewer points do not make a profile.
inline constexpr std::size_t kFewestProfilePoints = 100;

/// Values along the normal, inwards; the surface is in the middle.
using Profile = std::array<double, 2 * kProfileHalf + 1>;

using PointGroup = std::vector<const SurfacePoint*>;

/// The points that have a normal. The points must outlive the group.
PointGroup with_normals(const std::vector<SurfacePoint>& points);

/// A step along the unit direction n, one voxel long; mm.
Vec3 voxel_step(const VoxelGrid& grid, const Vec3& n);

/// Medians over the points of the image along their normals.
/// @param points  at least one, with normals.
Profile median_profile(const VolumeView& volume, const PointGroup& points);

/// A blurred edge: background, then a shell, then a core no brighter than the shell. With the depth
/// t below the surface in voxels and the normal distribution Phi,
///   f(t) = background + (shell - background) Phi(t / sigma) + (core - shell) Phi((t - w) / sigma).
/// Cortical bone is such a shell. The blur hides it, and the values a voxel or two below the
/// surface are those of a mixture.
struct EdgeModel {
  double background = 0, shell = 0, core = 0;  ///< the image's values; shell >= background, core
  double thickness = 0;                        ///< of the shell, w, voxels
  double sigma = 0;                            ///< of the blur, voxels
  double shift = 0;                            ///< of the surface, voxels below the profile's
  double residual = 0;                         ///< model against profile: root mean square

  /// The step from the background to the shell, native units.
  double height() const { return shell - background; }
  /// f(0): midway between background and shell, less what the core takes through the blur.
  double level() const;
};

/// Cortical bone is seldom thicker, voxels.
inline constexpr double kThickestShell = 2.5;

/// Fits the model to a profile by least squares. The blur hides whether a shell is thin and bright
/// or thick and less bright; the thickness is therefore bounded, and a penalty on the shell's
/// contrast to background and core keeps a shell that explains no more than noise at zero.
/// @param thickest  bound of the shell's thickness from above, voxels, more than 1; from below it
///                  is 1.
EdgeModel fit_edge_model(const Profile& profile, double thickest = kThickestShell);

}  // namespace mesamis::detail::restore
