// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "mesamis/fit/bending.h"

namespace mesamis {

/// Takes the terraces off that slices thicker than their pixels leave on slopes.
///
/// A slice places the surface where it crosses the slice's plane; between two planes the place is
/// interpolated, and follows the slices in steps. With the distance between slices f, in shortest
/// sides of a voxel (the sum over axes a of s_a c_a n_a^2 sin^2(pi x_a), where s is the voxel's side, n
/// the normal, x the place in voxels, and c grows from 0 at s = 1.05 to 1 at s = 1.5), points move to
/// the least of
///   sum of 4 w / (1 + K f) |x - goal|^2 + 8 |L x|^2,   K = min(5000, 1 / t^2),
/// with the umbrella operator L. The turn t between the normals of neighbours, smoothed far enough for
/// terraces to vanish, and the greatest of three rings, tells edges and small shapes, which bending
/// would round off: they are held. In each of three rounds the goals gain what the last one has lost
/// (Bregman's iteration). No point moves farther than half of the distance f.
/// @param surface  in the grid's own axes.
/// @param springs  whose weights w hold the points where they are; their goals do not count.
/// @return where the points are then; the surface's own points where the grid has_thick_slices() is
///         false.
///
/// O(n log n) for n points. The same bits for any number of threads.
std::vector<Vec3> without_terraces(const SurfaceSpace& space, const TriMesh& surface,
                                   const Neighbors& neighbors, Springs springs);

}  // namespace mesamis
