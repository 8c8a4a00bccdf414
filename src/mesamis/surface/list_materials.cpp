// SPDX-License-Identifier: Apache-2.0
#include "mesamis/surface/list_materials.h"

#include <algorithm>
#include <array>

#include "mesamis/base/parallel.h"
#include "mesamis/surface/neighbours.h"

namespace mesamis::detail::surface {
namespace {

/// The materials at a node and around it, and how many they are.
struct Around {
  std::array<Index, 15> materials{};
  std::size_t count = 0;

  Around(const GridMemberships& grid, std::size_t node) {
    add(grid.material[node]);
    const Neighbours neighbours(grid.size, static_cast<Index>(node));
    for (std::size_t s = 0; s < 7; ++s) {
      for (const Index other : {neighbours[s], neighbours[s + 7]}) {
        if (other != kNoIndex) add(grid.material[static_cast<std::size_t>(other)]);
      }
    }
  }

  void add(Index material) {
    const auto end = materials.begin() + static_cast<std::ptrdiff_t>(count);
    if (std::find(materials.begin(), end, material) == end) materials[count++] = material;
  }
};

}  // namespace

void list_materials(GridMemberships& grid) {
  const std::size_t nodes = grid.material.size();
  grid.first.assign(nodes + 1, 0);
  parallel_for(nodes, [&](std::size_t n) {
    const std::size_t count = Around(grid, n).count;
    if (count > 1) grid.first[n + 1] = static_cast<std::int64_t>(count);
  });
  for (std::size_t n = 0; n < nodes; ++n) grid.first[n + 1] += grid.first[n];
  grid.listed.resize(static_cast<std::size_t>(grid.first.back()));
  grid.value.assign(grid.listed.size(), 0);
  parallel_for(nodes, [&](std::size_t n) {
    if (grid.first[n] == grid.first[n + 1]) return;
    const Around around(grid, n);
    std::copy_n(around.materials.begin(), around.count, grid.listed.begin() + grid.first[n]);
  });
}

}  // namespace mesamis::detail::surface
