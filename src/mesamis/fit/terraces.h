// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "mesamis/fit/bending.h"

namespace mesamis::detail::fit {

/// How far terraces let a point move at most, in the unit of the surface; 0 without thick slices.
double most_moved_by_terraces(const SurfaceSpace& space);

/// Lowers the terraces that slices thicker than their pixels leave on slopes.
///
/// A slice places the surface where it crosses the slice's plane; between two planes the place is
/// interpolated, and follows the slices in steps. With f, which is 0 at the planes and about the
/// thickness of a slice midway between two (the sum over axes a of s_a c_a n_a^2 sin^2(pi x_a), where
/// s is the voxel's side over the shortest one, n the normal, x the place in voxels, and c grows from 0
/// at s = 1.05 to 1 at s = 1.5), points move towards the least of
///   sum of 4 w / (1 + K f) |x - goal|^2 + 8 |L x|^2,   K = min(5000, (0.16 / t)^3),
/// with the umbrella operator L, see relax(). The turn t, radians, between the normals of neighbours,
/// smoothed far enough for terraces to vanish, and the greatest of three rings, tells edges and
/// rounder shapes, which bending would flatten: they are held. Bumps lower than a slice and narrower
/// than some five edges look like terraces and go. In each of three rounds the goals gain what the
/// last one has lost (Bregman's iteration). No point moves farther than 0.4 f.
/// @param surface  in the grid's own axes.
/// @param springs  whose weights w hold the points where they are; their goals do not count. Points on
///                 open rims must be held, or they shrink inwards.
/// @return where the points are then; the surface's own points where the grid has_thick_slices() is
///         false.
///
/// O(n log n) for n points. The same bits for any number of threads.
std::vector<Vec3> without_terraces(const SurfaceSpace& space, const TriMesh& surface,
                                   const Neighbors& neighbors, Springs springs);

}  // namespace mesamis::detail::fit
