// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include "mesamis/image/volume.h"
#include "mesamis/rooms.h"

namespace mesamis::detail::restore {

/// Voxels spread evenly over a grid, in the order of the samples, each with all 26 neighbours.
/// @param about  how many, > 0; fewer at borders and in small grids.
///
/// O(voxels found).
inline std::vector<std::array<Index, 3>> spread_voxels(const VoxelGrid& grid, std::size_t about) {
  const std::size_t every = std::max<std::size_t>(1, grid.voxel_count() / about);
  std::vector<std::array<Index, 3>> voxels;
  for (std::size_t n = 0; n < grid.voxel_count(); n += every) {
    const std::array<Index, 3> at = grid.voxel(n);
    bool within = true;
    for (std::size_t a = 0; a < 3; ++a) within = within && at[a] >= 1 && at[a] + 1 < grid.size[a];
    if (within) voxels.push_back(at);
  }
  return voxels;
}

}  // namespace mesamis::detail::restore
