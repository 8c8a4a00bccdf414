// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "mesamis/surface/grid_partition.h"

namespace mesamis::detail::surface {

/// How extract_net_on_grid() works.
struct NetOptions {
  bool close_at_box = true;  ///< see PartitionOptions
  /// Of each label 1 if its surface is wanted; all others are one object, without boundaries within
  /// it. Empty: all are wanted.
  std::vector<char> chosen{};
};

/// Extracts the boundaries between objects as a surface net: one point in each cube of eight nodes,
/// at the mean of the points where the cube's edges are cut, two triangles for each edge that is
/// cut. A third of the triangles of extract_partition_on_grid(), and of nearly one shape: for
/// surfaces that are smoothed afterwards.
///
/// Boundaries are joined as on the grid's Kuhn tetrahedra. Where one point would not do, because a
/// cube holds several pieces of boundaries, or one that is no disc for each object, the cube keeps
/// the triangles of its tetrahedra; where an object touches itself across a face of two cubes, the
/// face keeps its points. The two triangles at an edge lie within the tetrahedra between its ends
/// and the points beside it, else four triangles stand for them. So nothing intersects, and what
/// extract_partition() promises holds for chosen objects and that of all others.
/// Source: Gibson, Constrained elastic surface nets, 1998; Ju and Udeshi, Intersection-free
/// contouring on an octree grid, 2006.
/// @return as extract_partition_on_grid().
/// @throws InputError  as extract_partition_on_grid().
///
/// O(nodes + s log s) for s triangles. The same bits for any number of threads.
PartitionSurface extract_net_on_grid(const GridMemberships& memberships,
                                     const NetOptions& options = {});

/// The same of the cubes above some slices, and of the edges at them.
/// @param memberships  of some slices of a larger grid: with one slice below these, as far as there
///                     is one, and two above.
PartitionPart extract_net_part(const GridMemberships& memberships, const NodeSlices& slices,
                               const NetOptions& options = {});

}  // namespace mesamis::detail::surface
