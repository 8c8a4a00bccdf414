// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "mesamis/surface/grid_partition.h"

namespace mesamis::detail::surface {

/// How many nodes away other memberships matter to one that is raised.
inline constexpr Index kLiftReach = 4;

/// Raises the membership of each node's own material, so that it wins, or nearly: where the
/// material is one node thick, by so much that it stays about as thick. What each node asks for is
/// averaged along the material, so that its boundaries stay smooth; match_volumes() does the rest.
/// @param grid  at each node listed, its own material is listed first.
void lift_memberships(GridMemberships& grid);

}  // namespace mesamis::detail::surface
