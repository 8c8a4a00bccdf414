// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "mesamis/fit/bending.h"
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

/// Smooths the boundaries of labels, which have the steps of their voxels, and keeps their shape.
///
/// In each round all points move to the least of
///   sum of |x - goal|^2 + bending |L x|^2
/// with the umbrella operator L, and the goals, at first where the points were, gain what the round
/// has lost (Bregman's iteration, Osher et al. 2005): steps of a voxel go, bends of several voxels
/// come back, so that a ball hardly shrinks. Where moves would make the surface meet itself, in the
/// single precision of a file, points stop on their way or where they were. Points on the box of the
/// grid stay.
/// @param surface   in the grid's own axes, mm; closed, or boundaries of several objects that share
///                  edges; without self-intersections.
/// @param links     between Neighbors of the surface, one for each.
/// @return the same triangles.
/// @throws InputError  as require_sound(), or if the points do not fit the surface.
///
/// O(n log n) for n points. The same bits for any number of threads.
TriMesh smooth_surface(const TriMesh& surface, const VoxelGrid& grid, const Links& links,
                       const SmoothingOptions& options = {});

}  // namespace mesamis::detail::fit
