// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "mesamis/surface/grid_partition.h"

namespace mesamis {

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

}  // namespace mesamis
