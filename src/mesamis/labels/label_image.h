// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "mesamis/image/volume.h"
#include "mesamis/surface/grid_partition.h"

namespace mesamis::detail::labels {

/// Paints memberships: an image whose edges are the boundaries between labels.
///
/// Labels get the numbers 0, 1, 2 ... so that labels which meet differ: each the least that none of
/// the labels before it has that it meets, the label 0 first. A node has the mean of the numbers of
/// its labels, weighted by their memberships.
/// @param memberships  as extract_partition_on_grid() reads them.
/// @param grid         of as many voxels as there are nodes.
/// @return samples from 0 to the largest number; mostly four numbers are enough.
/// @throws InputError  if the sizes differ.
///
/// O(nodes + pairs of labels that meet, up to a logarithm). The same bits for any number of
/// threads.
Volume label_image(const GridMemberships& memberships, const VoxelGrid& grid);

}  // namespace mesamis::detail::labels
