// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "mesamis/fit/bending.h"
#include "mesamis/fit/boundary_parts.h"
#include "mesamis/image/volume.h"
#include "mesamis/rooms.h"
#include "mesamis/surface/tri_mesh.h"

namespace mesamis::detail::fit {

/// How a surface is smoothed.
struct SmoothingOptions {
  double bending = 110;  ///< weight of smoothness against the place where a point was, > 0
  int rounds = 5;        ///< at least 1: the more, the less of the shape is lost
  double reach = 1;      ///< voxels, > 0: how far a point may move
};

/// Options for the labels of a grid: where slices are thicker than their pixels, the steps between
/// slices are wide, and smoothing is firmer, comes back less and may go almost a slice.
SmoothingOptions smoothing_of_labels(const VoxelGrid& grid);

/// Boundaries that have the steps of voxels.
struct RoughBoundaries {
  const TriMesh& surface;  ///< in the grid's own axes, mm; closed, or boundaries of several objects
                           ///< that share edges; without self-intersections
  const Links& links;      ///< between Neighbors of the surface, one for each
  const BoundaryParts* parts = nullptr;  ///< nullptr: they are not looked at
};

/// Finds where the points of boundaries of labels, which have the steps of their voxels, go so that
/// these become smooth and keep their shape.
///
/// In each round all points move to the least of
///   sum of |x - goal|^2 + bending |L x|^2
/// with the umbrella operator L, and the goals, at first where the points were, gain what the round
/// has lost (Bregman's iteration, Osher et al. 2005): steps of a voxel go, bends of several voxels
/// come back, so that a ball hardly shrinks. A part that loses more than three quarters of its volume
/// in the first round, as a rod of two voxels does, starts again with goals that count so much more
/// that it keeps half of its width in each round. Points on the box of the grid stay.
/// @return of each point its place; there the surface may meet itself.
/// @throws InputError  as require_sound(), or if the points do not fit the surface.
///
/// O(n) for n points. The same bits for any number of threads.
std::vector<Vec3> smooth_places(const RoughBoundaries& rough, const VoxelGrid& grid,
                                const SmoothingOptions& options = {});

/// Moves the points of a surface to other places. Where it would meet itself, in the single precision
/// of a file, points stop on their way or where they were.
/// @param surface  without self-intersections.
/// @param places   one for each point.
/// @return the same triangles.
///
/// O(n log n) for n points. The same bits for any number of threads.
TriMesh moved_to(const TriMesh& surface, const VoxelGrid& grid, const std::vector<Vec3>& places);

}  // namespace mesamis::detail::fit
