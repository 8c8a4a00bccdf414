// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <random>

#include "mesamis/surface/grid_partition.h"

namespace mesamis {

/// Random memberships, all of them listed at each node.
inline GridMemberships random_grid(const std::array<Index, 3>& size, Index materials,
                                   unsigned seed) {
  std::mt19937 generator(seed);
  std::uniform_real_distribution<float> uniform(0, 1);
  GridMemberships grid{.size = size,
                       .spacing = {1, 2, 0.5},
                       .material = {},
                       .label = {},
                       .first = {0},
                       .listed = {},
                       .value = {}};
  for (Index m = 0; m < materials; ++m) grid.label.push_back(m);
  for (Index n = 0; n < size[0] * size[1] * size[2]; ++n) {
    const std::size_t begin = grid.value.size();
    for (Index m = 0; m < materials; ++m) {
      grid.listed.push_back(m);
      grid.value.push_back(uniform(generator));
    }
    const auto most =
        std::max_element(grid.value.begin() + std::ptrdiff_t(begin), grid.value.end());
    grid.material.push_back(static_cast<Index>(most - grid.value.begin() - std::ptrdiff_t(begin)));
    grid.first.push_back(static_cast<std::int64_t>(grid.value.size()));
  }
  return grid;
}

}  // namespace mesamis
