// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "mesamis/image/label_map.h"
#include "mesamis/surface/grid_partition.h"

namespace mesamis::detail::labels {

/// Takes probabilities as memberships: an object's boundary is where it is as probable as what lies
/// beside it, between the voxels.
///
/// The background has what the objects leave of 1. At each node the most probable wins, the
/// background and then the first of several.
/// @param from  at least 2 voxels along each axis.
/// @param grid  such as that of the scan; beyond the probabilities' voxels all is background.
/// @return a material per object, and material 0 for the background: their labels are 0, 1, 2 ...
/// @throws InputError  if the probabilities have fewer than 2 voxels along an axis.
///
/// O(voxels of the grid * objects), in threads; 12 bytes per voxel beside the result. The same bits
/// for any number of threads.
GridMemberships probable_memberships(const Probabilities& from, const VoxelGrid& grid);

/// The label that wins at each node.
std::vector<std::uint16_t> winning_labels(const GridMemberships& memberships);

}  // namespace mesamis::detail::labels
