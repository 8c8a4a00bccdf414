// SPDX-License-Identifier: Apache-2.0
#include "mesamis/surface/join_diagonals.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <iterator>

#include "mesamis/base/each_once.h"
#include "mesamis/base/parallel.h"
#include "mesamis/surface/disjoint_sets.h"
#include "mesamis/surface/label_parts.h"
#include "mesamis/surface/neighbours.h"

namespace mesamis::detail::surface {
namespace {

using Place = std::array<Index, 3>;

/// Some of a cube's nodes: bit i + 2 j + 4 k stands for the node (i, j, k).
using Nodes = unsigned;
constexpr Nodes kCube = 255;

/// Calls visit(corner) for each node.
template <class Visit>
void for_each_corner(Nodes nodes, Visit visit) {
  for (; nodes != 0; nodes &= nodes - 1) visit(static_cast<unsigned>(std::countr_zero(nodes)));
}

/// Whether an edge of the Kuhn tetrahedra joins two corners.
bool share_edge(unsigned a, unsigned b) { return (a & b) == a || (a & b) == b; }
bool share_face(unsigned a, unsigned b) { return std::has_single_bit(a ^ b); }

/// The nodes that are connected with the first one.
Nodes first_part(Nodes nodes, bool (*are_neighbours)(unsigned, unsigned)) {
  Nodes found = nodes & (0U - nodes);
  for (Nodes before = 0; found != before;) {
    before = found;
    for_each_corner(before, [&](unsigned a) {
      for_each_corner(nodes, [&](unsigned b) {
        if (are_neighbours(a, b)) found |= 1U << b;
      });
    });
  }
  return found;
}

/// Whether edges connect all of an object's nodes in a cube, and those of the background only where
/// faces do.
bool is_sound(Nodes object) {
  if (first_part(object, share_edge) != object) return false;
  for (Nodes rest = kCube & ~object; rest != 0;) {
    const Nodes part = first_part(rest, share_face);
    if (part != first_part(rest, share_edge)) return false;
    rest &= ~part;
  }
  return true;
}

/// For each set of an object's nodes in a cube the sets of fewest others that make it sound.
using Fills = std::array<std::vector<Nodes>, kCube + 1>;

Fills find_fills() {
  Fills fills;
  for (Nodes object = 0; object <= kCube; ++object) {
    int fewest = 8;
    for (Nodes fill = 0; fill <= kCube; ++fill) {
      const int count = std::popcount(fill);
      if ((fill & object) != 0 || count > fewest || !is_sound(object | fill)) continue;
      if (count < fewest) fills[object].clear();
      fewest = count;
      fills[object].push_back(fill);
    }
  }
  return fills;
}

struct Fill {
  std::int64_t node = 0;
  Index label = 0;
};

class Joiner {
 public:
  explicit Joiner(const LabelGrid& grid)
      : grid_(grid), stride_{1, grid.size[0], std::ptrdiff_t{grid.size[0]} * grid.size[1]} {}

  /// The nodes to take in the cubes above slice k.
  std::vector<Fill> fills_above(Index k) const {
    std::vector<Fill> found;
    for (Place low{0, 0, k}; low[1] + 1 < grid_.size[1]; ++low[1]) {
      for (low[0] = 0; low[0] + 1 < grid_.size[0]; ++low[0]) fill_cube(low, found);
    }
    return found;
  }

 private:
  static Place corner_of(Place low, unsigned corner) {
    for (std::size_t a = 0; a < 3; ++a) low[a] += static_cast<Index>(corner >> a & 1U);
    return low;
  }
  std::size_t number(const Place& p) const {
    return static_cast<std::size_t>(p[0] + p[1] * stride_[1] + p[2] * stride_[2]);
  }
  std::uint16_t label_at(const Place& place) const { return grid_.labels[number(place)]; }

  /// The nodes of a label in the cube above a node.
  Nodes in_cube(const Place& low, std::uint16_t label) const {
    Nodes found = 0;
    for (unsigned corner = 0; corner < 8; ++corner) {
      if (label_at(corner_of(low, corner)) == label) found |= 1U << corner;
    }
    return found;
  }

  /// Whether no full cube holds the node.
  bool is_thin(const Place& place) const {
    for (unsigned corner = 0; corner < 8; ++corner) {
      Place low = place;
      bool within = true;
      for (std::size_t a = 0; a < 3; ++a) {
        low[a] -= static_cast<Index>(corner >> a & 1U);
        within = within && low[a] >= 0 && low[a] + 1 < grid_.size[a];
      }
      if (within && in_cube(low, label_at(place)) == kCube) return false;
    }
    return true;
  }

  /// How many nodes of a label are among a node's neighbours.
  int count_around(const Place& place, std::uint16_t label) const {
    Place low{}, high{};
    for (std::size_t a = 0; a < 3; ++a) {
      low[a] = std::max(0, place[a] - 1);
      high[a] = std::min(grid_.size[a] - 1, place[a] + 1);
    }
    int found = 0;
    for (Index k = low[2]; k <= high[2]; ++k) {
      for (Index j = low[1]; j <= high[1]; ++j) {
        for (Index i = low[0]; i <= high[0]; ++i) found += label_at({i, j, k}) == label ? 1 : 0;
      }
    }
    return found;
  }

  /// Looks at each label of a cube.
  void fill_cube(const Place& low, std::vector<Fill>& found) const {
    const Nodes background = in_cube(low, 0);
    for (Nodes rest = kCube & ~background; rest != 0;) {
      const auto label = label_at(corner_of(low, static_cast<unsigned>(std::countr_zero(rest))));
      const Nodes object = in_cube(low, label);
      rest &= ~object;
      for_each_corner(fill_of(low, object, background), [&](unsigned c) {
        found.push_back({static_cast<std::int64_t>(number(corner_of(low, c))), label});
      });
    }
  }

  /// The nodes that one of them takes.
  Nodes fill_of(const Place& low, Nodes object, Nodes background) const {
    static const Fills kFills = find_fills();
    const std::vector<Nodes>& choice = kFills[object];
    bool thin = false;
    if (choice.front() == 0) return 0;
    for_each_corner(object, [&](unsigned c) { thin = thin || is_thin(corner_of(low, c)); });
    if (!thin) return 0;
    const auto label = label_at(corner_of(low, static_cast<unsigned>(std::countr_zero(object))));
    Nodes best = 0;
    int most = -1;
    for (const Nodes fill : choice) {
      if ((fill & ~background) != 0) continue;
      int near = 0;
      for_each_corner(fill, [&](unsigned c) { near += count_around(corner_of(low, c), label); });
      if (near > most) best = fill;
      most = std::max(most, near);
    }
    return best;
  }

  const LabelGrid& grid_;
  std::array<std::ptrdiff_t, 3> stride_;
};

/// The nodes to take, in their order; of several objects the first takes a node.
std::vector<Fill> fills_of(const LabelGrid& grid) {
  const Joiner joiner(grid);
  std::vector<std::vector<Fill>> above(static_cast<std::size_t>(grid.size[2] - 1));
  parallel_for_each(above.size(),
                    [&](std::size_t k) { above[k] = joiner.fills_above(static_cast<Index>(k)); });
  std::vector<Fill> all;
  for (const auto& fills : above) all.insert(all.end(), fills.begin(), fills.end());
  std::sort(all.begin(), all.end(), [](const Fill& a, const Fill& b) {
    return a.node != b.node ? a.node < b.node : a.label < b.label;
  });
  const auto same_node = [](const Fill& a, const Fill& b) { return a.node == b.node; };
  all.erase(std::unique(all.begin(), all.end(), same_node), all.end());
  return all;
}

/// What a node does that an object takes.
/// @param labels  those of lower nodes have been taken.
DiagonalJoin join_at(const LabelGrid& grid, std::span<const std::uint16_t> labels,
                     std::span<const Index> parts, const Fill& fill) {
  DiagonalJoin join{fill.node, fill.label, 0, {}};
  const Neighbours around(grid.size, static_cast<Index>(fill.node));
  auto end = join.touched.begin();
  for (std::size_t i = 0; i < 14; ++i) {
    const Index n = around[i];
    if (n == kNoIndex || grid.labels[n] != fill.label) continue;
    if (std::find(join.touched.begin(), end, parts[n]) == end) *end++ = parts[n];
  }
  std::fill(end, join.touched.end(), kNoIndex);
  join.change = euler_change(around.set_of([&](Index n) { return labels[n] == fill.label; }));
  return join;
}

/// The sets of joins that touch each other.
DisjointSets::Numbers clusters_of(std::span<const DiagonalJoin> joins,
                                  const std::array<Index, 3>& size) {
  DisjointSets sets(joins.size());
  for (std::size_t j = 0; j < joins.size(); ++j) {
    const auto [x, y, z] = grid_place(size, joins[j].node);
    for (Index k = z; k <= std::min(z + 1, size[2] - 1); ++k) {
      for (Index i = std::max(0, y - 1); i <= std::min(y + 1, size[1] - 1); ++i) {
        const std::int64_t row = std::int64_t{size[0]} * (i + std::int64_t{size[1]} * k);
        auto at = std::lower_bound(
            joins.begin(), joins.end(), row + std::max(0, x - 1),
            [](const DiagonalJoin& join, std::int64_t node) { return join.node < node; });
        for (; at != joins.end() && at->node <= row + std::min(x + 1, size[0] - 1); ++at) {
          if (at->label == joins[j].label) {
            sets.unite(j, static_cast<std::size_t>(at - joins.begin()));
          }
        }
      }
    }
  }
  return sets.numbers();
}

/// The sets of the parts that joins touch.
std::vector<std::size_t> touched_sets(std::span<const DiagonalJoin* const> joins,
                                      DisjointSets& parts) {
  std::vector<std::size_t> sets;
  for (const DiagonalJoin* join : joins) {
    for (const Index part : join->touched) {
      if (part == kNoIndex) break;
      sets.push_back(parts.find(static_cast<std::size_t>(part)));
    }
  }
  sort_once(sets);
  return sets;
}

std::vector<DiagonalJoin> joins_of(const std::vector<Fill>& fills, const LabelGrid& grid,
                                   std::span<const Index> parts) {
  std::vector<std::uint16_t> labels(grid.labels.begin(), grid.labels.end());
  std::vector<DiagonalJoin> joins;
  joins.reserve(fills.size());
  for (const Fill& fill : fills) {
    joins.push_back(join_at(grid, labels, parts, fill));
    labels[static_cast<std::size_t>(fill.node)] = static_cast<std::uint16_t>(fill.label);
  }
  return joins;
}

}  // namespace

std::vector<DiagonalJoin> find_diagonal_joins(const LabelGrid& grid, std::span<const Index> parts) {
  return joins_of(fills_of(grid), grid, parts);
}

std::vector<DiagonalJoin> choose_joins(std::span<const DiagonalJoin> joins,
                                       const std::array<Index, 3>& size) {
  const DisjointSets::Numbers clusters = clusters_of(joins, size);
  std::vector<std::vector<const DiagonalJoin*>> of_cluster(
      static_cast<std::size_t>(clusters.count));
  std::size_t part_count = 0;
  for (std::size_t j = 0; j < joins.size(); ++j) {
    of_cluster[static_cast<std::size_t>(clusters.of_item[j])].push_back(&joins[j]);
    for (const Index part : joins[j].touched) {
      part_count = std::max(part_count, static_cast<std::size_t>(part + 1));
    }
  }
  DisjointSets parts(part_count);
  std::vector<DiagonalJoin> chosen;
  for (const auto& cluster : of_cluster) {
    Index change = 0;
    for (const DiagonalJoin* join : cluster) change += join->change;
    const std::vector<std::size_t> touched = touched_sets(cluster, parts);
    if (change + std::ssize(touched) - 1 < 0) continue;
    for (const std::size_t set : touched) parts.unite(touched.front(), set);
    for (const DiagonalJoin* join : cluster) chosen.push_back(*join);
  }
  std::sort(chosen.begin(), chosen.end(),
            [](const DiagonalJoin& a, const DiagonalJoin& b) { return a.node < b.node; });
  return chosen;
}

void take_nodes(std::span<const DiagonalJoin> joins, std::int64_t first,
                std::span<std::uint16_t> labels) {
  for (const DiagonalJoin& join : joins) {
    const std::int64_t n = join.node - first;
    if (n < 0 || n >= std::ssize(labels)) continue;
    labels[static_cast<std::size_t>(n)] = static_cast<std::uint16_t>(join.label);
  }
}

std::vector<std::uint16_t> join_diagonals(const LabelGrid& grid) {
  std::vector<std::uint16_t> labels(grid.labels.begin(), grid.labels.end());
  const std::vector<Fill> fills = fills_of(grid);
  if (fills.empty()) return labels;
  const auto joins = joins_of(fills, grid, find_label_parts(grid).of_node);
  take_nodes(choose_joins(joins, grid.size), 0, labels);
  return labels;
}

}  // namespace mesamis::detail::surface
