// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesamis/surface/grid_partition.h"

namespace mesamis::detail::surface {

/// A node that changes its material.
struct Yield {
  std::int64_t node = 0;
  Index to = 0;  ///< a material
};

/// Finds the nodes beside another material of a larger membership, their own not being much
/// smaller.
/// @param grid  at each node listed, its own material is listed first.
/// @return in the order of the nodes.
///
/// O(nodes).
std::vector<Yield> find_yields(const GridMemberships& grid);

/// Lets nodes yield one after the other, where that is allowed, see yield_nodes().
/// @param wanted  nodes of the grid, in their order.
/// @param nodes   how many of each material the whole grid has.
/// @param grid    its materials are changed; its lists are not read. Of some slices of a larger
///                grid, two beside those of the nodes are needed, those below as they are then.
/// @return those that have yielded, in the order of the nodes.
///
/// O(wanted).
std::vector<Yield> yield_where_allowed(std::span<const Yield> wanted,
                                       std::span<const std::int64_t> nodes, GridMemberships& grid);

/// Gives single nodes, steps of stairs, to the neighbouring material of the largest membership.
///
/// A node yields only if the topology of both materials stays (in the Kuhn tetrahedra around it,
/// each of them covers one disc of the sphere of neighbours), if materials of one label do not
/// become neighbours, if none of its neighbours is left one node thick, and if its own membership
/// is not much smaller. So thin parts and their ends stay. Nodes at the faces of the grid stay, and
/// those of materials of fewer than 100 nodes.
/// @param grid  at each node listed, its own material is listed first. Its materials are changed;
///              its lists are then those of the materials before.
/// @return how many nodes were given away.
///
/// O(nodes), in the order of the nodes.
std::int64_t yield_nodes(GridMemberships& grid);

}  // namespace mesamis::detail::surface
