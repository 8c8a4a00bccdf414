// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "mesamis/image/volume.h"
#include "mesamis/rooms.h"

/// Where a volume crosses a level, seen along its grid lines: points and area of a level set
/// without a mesh.
namespace mesamis::detail::restore {

/// A point of a surface and its unit normal, pointing out of the (brighter) object.
struct SurfacePoint {
  Vec3 position;  ///< in the grid's own axes, mm
  Vec3 normal;    ///< unit length; zero where it is not known
};

/// Computes the gradient of the samples at a voxel, by central differences, one-sided at the
/// border.
/// @param i, j, k  within the grid, which has at least 2 voxels along each axis.
/// @return native units per mm.
Vec3 gradient_at(const VolumeView& volume, Index i, Index j, Index k);

/// Finds the points where a volume's grid lines cross a level, by linear interpolation, with
/// normals from the gradient of the samples.
/// @param volume  at least 2 voxels along each axis.
/// @param level   native units.
/// @param most    >= 1, about how many points are wanted: from more, every n-th is taken, evenly.
///                Less than twice as many are returned.
/// @return in the order of the voxels; empty if nothing crosses the level.
///
/// O(voxels), two passes.
std::vector<SurfacePoint> crossing_points(const VolumeView& volume, double level, std::size_t most);

/// Estimates the area of a level set, mm^2, from the number of its crossings with the grid lines
/// (Cauchy's formula): along an axis each crossing stands for the area of the voxel's face across
/// the axis, and a surface whose normals are spread over all directions has two thirds of the three
/// areas projected along the axes.
/// @param level  native units.
double level_area(const VolumeView& volume, double level);

}  // namespace mesamis::detail::restore
