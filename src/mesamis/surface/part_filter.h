// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "mesamis/surface/grid_partition.h"

namespace mesamis::detail::surface {

/// How many nodes away the Gaussian of so many nodes is cut off. The filter, which applies it
/// twice, reaches twice as far.
Index filter_radius(double sigma_voxel);

/// Lists the materials at each node, see list_materials(). The membership of each is 2 G p - G G p
/// for the indicator p of a part and a Gaussian G; beyond the grid p is as at the nearest node.
/// @param part         of each node: where p is 1. The materials of the grid may differ from it.
/// @param sigma_voxel  of the Gaussian, nodes, along each axis.
/// @param grid         its size and materials are read; its lists are set.
void filter_parts(const std::vector<Index>& part, double sigma_voxel, GridMemberships& grid);

}  // namespace mesamis::detail::surface
