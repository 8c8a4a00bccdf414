// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>

#include "mesamis/base/types.h"
#include "mesamis/surface/grid_field.h"

namespace mesamis::detail::surface {

/// The 14 nodes of a grid with which one shares an edge of the Kuhn tetrahedra: seven below along
/// kKuhnSteps, then seven above in the same order. kNoIndex where the grid ends.
class Neighbours {
 public:
  /// @param size  nodes along i, j, k.
  Neighbours(const std::array<Index, 3>& size, Index node) {
    const std::array<Index, 3> at = grid_place(size, node);
    for (std::size_t s = 0; s < 7; ++s) {
      const auto& d = kKuhnSteps[s];
      const Index step = d[0] + size[0] * (d[1] + size[1] * d[2]);
      bool has_below = true, has_above = true;
      for (std::size_t a = 0; a < 3; ++a) {
        has_below = has_below && at[a] >= d[a];
        has_above = has_above && at[a] + d[a] < size[a];
      }
      nodes_[s] = has_below ? node - step : kNoIndex;
      nodes_[s + 7] = has_above ? node + step : kNoIndex;
    }
  }
  /// The i-th one, or kNoIndex.
  Index operator[](std::size_t i) const { return nodes_[i]; }

  /// Those that are of a kind, as a set.
  /// @param is_in  called with the node of each neighbour that there is.
  template <class IsIn>
  unsigned set_of(const IsIn& is_in) const {
    unsigned set = 0;
    for (std::size_t i = 0; i < 14; ++i) {
      if (nodes_[i] != kNoIndex && is_in(nodes_[i])) set |= 1U << i;
    }
    return set;
  }

  /// The step to a neighbour.
  static std::array<Index, 3> step_to(std::size_t i) {
    const auto& d = kKuhnSteps[i % 7];
    return i < 7 ? std::array<Index, 3>{-d[0], -d[1], -d[2]} : d;
  }

 private:
  std::array<Index, 14> nodes_{};
};

/// Sets of a node's neighbours have a bit for each.
inline constexpr unsigned kAllNeighbours = (1U << 14) - 1;

/// How many parts a set of a node's neighbours has: connected along edges of the tetrahedra.
Index count_parts(unsigned neighbours);

/// By how much the Euler characteristic of an object grows when it takes a node.
/// @param object  the node's neighbours that are of the object.
Index euler_change(unsigned object);

}  // namespace mesamis::detail::surface
