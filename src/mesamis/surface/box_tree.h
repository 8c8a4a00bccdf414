// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <limits>
#include <span>
#include <vector>

#include "mesamis/base/types.h"
#include "mesamis/rooms.h"

namespace mesamis::detail::surface {

/// Whether two boxes share a point; touching counts.
inline bool overlap(const Box& a, const Box& b) {
  return a.lo.x <= b.hi.x && b.lo.x <= a.hi.x && a.lo.y <= b.hi.y && b.lo.y <= a.hi.y &&
         a.lo.z <= b.hi.z && b.lo.z <= a.hi.z;
}

/// A box that overlaps none.
inline constexpr double kFar = std::numeric_limits<double>::infinity();
inline constexpr Box kNoBox{{kFar, kFar, kFar}, {-kFar, -kFar, -kFar}};

/// The least box around two others.
inline Box united(const Box& a, const Box& b) {
  return {{std::min(a.lo.x, b.lo.x), std::min(a.lo.y, b.lo.y), std::min(a.lo.z, b.lo.z)},
          {std::max(a.hi.x, b.hi.x), std::max(a.hi.y, b.hi.y), std::max(a.hi.z, b.hi.z)}};
}

/// A bounding volume hierarchy over boxes that may change; finds the boxes that overlap another.
class BoxTree {
 public:
  /// O(n log n) for n boxes.
  explicit BoxTree(std::span<const Box> boxes);

  /// Gives item i another box. O(log n); the hierarchy itself stays.
  void update(std::size_t i, const Box& box);

  /// Calls visit(i) for each item whose box overlaps the given one (touching counts), always in the
  /// same order, until it returns false.
  template <class Visit>
  void for_each_overlap(const Box& box, Visit&& visit) const {
    std::array<Index, 64> stack;  // halved at each step: depth at most 32
    std::size_t size = 0;
    if (!nodes_.empty()) stack[size++] = 0;
    while (size > 0) {
      const Index n = stack[--size];
      const Node& node = nodes_[static_cast<std::size_t>(n)];
      if (!overlap(node.box, box)) continue;
      if (node.item != kNoIndex) {
        if (!visit(static_cast<std::size_t>(node.item))) return;
        continue;
      }
      stack[size++] = node.second;
      stack[size++] = n + 1;
    }
  }

 private:
  struct Node {
    Box box;
    Index parent = kNoIndex;
    Index second = kNoIndex;  // the first child comes next
    Index item = kNoIndex;    // of a leaf
  };

  void build(std::span<const Box> boxes, std::span<Index> items, Index place, Index parent);

  std::vector<Node> nodes_;
  std::vector<Index> leaf_of_;
};

}  // namespace mesamis::detail::surface
