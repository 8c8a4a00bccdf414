// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

#include "mesamis/image/edge_sides.h"

/// The image on the way through an object's surface, and the edge that explains it.
namespace mesamis {

inline constexpr int kProfileHalf = 12;       // samples on either side of the surface
inline constexpr double kProfileStep = 0.25;  // voxels
using Profile = std::array<double, 2 * kProfileHalf + 1>;

using PointGroup = std::vector<const SurfacePoint*>;

/// The unit direction n in voxels: one step along it is one voxel long.
Vec3 voxel_direction(const Volume& volume, const Vec3& n);

/// Medians over the points of the image along their normals, inwards; the surface is in the middle.
Profile median_profile(const Volume& volume, const PointGroup& points);

/// A blurred edge: outside, then a shell, then a core no brighter than the shell. With the depth t
/// below the surface in voxels and the normal distribution Phi,
///   f(t) = outside + (shell - outside) Phi(t / sigma) + (core - shell) Phi((t - w) / sigma).
/// Bones have such shells; the blur hides them, and what lies a voxel or two deep then misleads.
struct Edge {
  double outside = 0, shell = 0, core = 0;  ///< the image's values; shell >= outside, core
  double thickness = 0;                     ///< of the shell, w, voxels
  double sigma = 0;                         ///< voxels
  double place = 0;                         ///< of the surface, voxels below that of the profile
  double misfit = 0;                        ///< to the profile: root mean square
  double height() const { return shell - outside; }
  /// f(0): midway between outside and shell, less what the core takes through the blur.
  double level() const;
};

/// The edge that comes nearest to a profile, by least squares. The blur hides whether a shell is
/// thin and bright or thick and less so; it is therefore taken to be one to two and a half voxels,
/// and only as bright as is worth it.
Edge fit_edge(const Profile& profile);

}  // namespace mesamis
