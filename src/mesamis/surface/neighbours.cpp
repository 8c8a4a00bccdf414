// SPDX-License-Identifier: Apache-2.0
#include "mesamis/surface/neighbours.h"

#include <bit>

namespace mesamis::detail::surface {
namespace {

/// Of each neighbour of a node, a bit for each other neighbour beside it.
std::array<unsigned, 14> links() {
  std::array<unsigned, 14> links{};
  for (std::size_t a = 0; a < 14; ++a) {
    for (std::size_t b = 0; b < 14; ++b) {
      const auto from = Neighbours::step_to(a), to = Neighbours::step_to(b);
      const std::array<Index, 3> step{to[0] - from[0], to[1] - from[1], to[2] - from[2]};
      for (std::size_t i = 0; i < 14; ++i) {
        if (Neighbours::step_to(i) == step) links[a] |= 1U << b;
      }
    }
  }
  return links;
}

}  // namespace

Index count_parts(unsigned neighbours) {
  static const std::array<unsigned, 14> kLinks = links();
  Index count = 0;
  for (; neighbours != 0; ++count) {
    unsigned reached = neighbours & (0U - neighbours);
    for (unsigned before = 0; reached != before;) {
      before = reached;
      for (unsigned rest = reached; rest != 0; rest &= rest - 1) {
        reached |= kLinks[static_cast<std::size_t>(std::countr_zero(rest))] & neighbours;
      }
    }
    neighbours &= ~reached;
  }
  return count;
}

Index euler_change(unsigned object) {
  return count_parts(kAllNeighbours & ~object) - count_parts(object);
}

}  // namespace mesamis::detail::surface
