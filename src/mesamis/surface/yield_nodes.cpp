// SPDX-License-Identifier: Apache-2.0
#include "mesamis/surface/yield_nodes.h"

#include <algorithm>
#include <array>
#include <vector>

#include "mesamis/surface/neighbours.h"

namespace mesamis::detail::surface {
namespace {

/// A node whose membership is smaller by more stays: less than at the end of a thin part, more than
/// at the corner of a thick one.
constexpr float kMostYield = 0.35F;

/// Materials of fewer nodes neither give nor take: their volumes could not be matched.
constexpr std::int64_t kFewNodes = 100;

/// Whether neighbours cover one disc of the sphere around a node.
bool is_disc(unsigned nodes) {
  return count_parts(nodes) == 1 && count_parts(kAllNeighbours & ~nodes) == 1;
}

/// The material that a node is to be given to; its own if it stays.
Index wanted_by(const GridMemberships& grid, std::size_t n) {
  const auto begin = grid.value.begin() + grid.first[n],
             end = grid.value.begin() + grid.first[n + 1];
  if (begin == end) return grid.material[n];
  const auto most = std::max_element(begin, end);
  if (*most - *begin > kMostYield) return grid.material[n];
  return grid.listed[static_cast<std::size_t>(most - grid.value.begin())];
}

/// Whether the node behind a neighbour, seen from the node, is of the same material: else that
/// neighbour would become thin.
bool is_backed(const GridMemberships& grid, Index neighbour, std::size_t direction) {
  const Index behind = Neighbours(grid.size, neighbour)[direction];
  return behind == kNoIndex || grid.material[behind] == grid.material[neighbour];
}

bool may_yield(const GridMemberships& grid, std::size_t n, Index to) {
  const Neighbours around(grid.size, static_cast<Index>(n));
  const Index own = grid.material[n];
  unsigned of_own = 0, of_other = 0;
  for (std::size_t i = 0; i < 14; ++i) {
    if (around[i] == kNoIndex) return false;
    const Index material = grid.material[around[i]];
    if (material == own && !is_backed(grid, around[i], i)) return false;
    if (material == own) of_own |= 1U << i;
    if (material == to) of_other |= 1U << i;
    if (material != to && grid.label[material] == grid.label[to]) return false;
  }
  return is_disc(of_own) && is_disc(of_other);
}

}  // namespace

std::vector<Yield> find_yields(const GridMemberships& grid) {
  std::vector<Yield> wanted;
  for (std::size_t n = 0; n < grid.material.size(); ++n) {
    const Index to = wanted_by(grid, n);
    if (to != grid.material[n]) wanted.push_back({static_cast<std::int64_t>(n), to});
  }
  return wanted;
}

std::vector<Yield> yield_where_allowed(std::span<const Yield> wanted,
                                       std::span<const std::int64_t> nodes, GridMemberships& grid) {
  std::vector<Yield> done;
  for (const Yield& yield : wanted) {
    const auto n = static_cast<std::size_t>(yield.node);
    if (std::min(nodes[grid.material[n]], nodes[yield.to]) < kFewNodes) continue;
    if (!may_yield(grid, n, yield.to)) continue;
    grid.material[n] = yield.to;
    done.push_back(yield);
  }
  return done;
}

std::int64_t yield_nodes(GridMemberships& grid) {
  std::vector<std::int64_t> nodes(grid.label.size(), 0);  // of each material
  for (const Index m : grid.material) ++nodes[m];
  return std::ssize(yield_where_allowed(find_yields(grid), nodes, grid));
}

}  // namespace mesamis::detail::surface
