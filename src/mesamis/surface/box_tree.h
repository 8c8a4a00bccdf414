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

/// What a hierarchy is built of.
struct PlacedItem {
  Vec3 center;  ///< of its box, twice
  Index item;
};

/// Puts the items with the lesser centres, along the axis along which these lie farthest apart, into
/// the first half. O(n).
/// @param items  at least two.
/// @return how many are in the first half.
std::size_t halve(std::span<PlacedItem> items);

/// A bounding volume hierarchy over boxes that may change; finds the boxes that overlap another, or
/// one another.
class BoxTree {
 public:
  /// Two nodes: the pairs of an item below the one and an item below the other; twice the same:
  /// the pairs of items below it.
  using NodePair = std::array<Index, 2>;

  /// O(n log n) for n boxes.
  explicit BoxTree(std::span<const Box> boxes);

  /// Gives item i another box. O(log n); the hierarchy itself stays.
  void update(std::size_t i, const Box& box);
  /// Gives all items other boxes. O(n); the hierarchy itself stays.
  void update(std::span<const Box> boxes);

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

  /// Pairs of nodes, about so many where there are enough items: each pair of items whose boxes
  /// overlap is one of exactly one of them.
  std::vector<NodePair> shares_of_pairs(std::size_t count) const;

  /// Calls visit(i, j) for each pair of different items of a share whose boxes overlap (touching
  /// counts), always in the same order.
  template <class Visit>
  void for_each_pair(const NodePair& share, Visit&& visit) const {
    const Node &one = node(share[0]), &other = node(share[1]);
    if (&one != &other && one.item != kNoIndex && other.item != kNoIndex) {
      if (overlap(one.box, other.box)) {
        visit(static_cast<std::size_t>(one.item), static_cast<std::size_t>(other.item));
      }
    } else {
      for_each_part(share, [&](const NodePair& part) { for_each_pair(part, visit); });
    }
  }

 private:
  struct Node {
    Box box;
    Index parent = kNoIndex;
    Index second = kNoIndex;  // the first child comes next
    Index item = kNoIndex;    // of a leaf
  };

  const Node& node(Index place) const { return nodes_[static_cast<std::size_t>(place)]; }

  /// Calls part(pair) for the pairs of children of two nodes that may hold what overlaps.
  template <class Part>
  void for_each_part(const NodePair& share, Part&& part) const {
    const Index a = share[0], b = share[1];
    const Node &one = node(a), &other = node(b);
    if (a == b) {
      if (one.item != kNoIndex) return;
      part({a + 1, a + 1});
      part({one.second, one.second});
      part({a + 1, one.second});
    } else if (overlap(one.box, other.box)) {
      const auto pair_with = [&](Index half) {
        if (other.item != kNoIndex) return part({half, b});
        part({half, b + 1});
        part({half, other.second});
      };
      if (one.item != kNoIndex) return pair_with(a);
      pair_with(a + 1);
      pair_with(one.second);
    }
  }

  void build(std::span<const Box> boxes, std::span<PlacedItem> items, Index place, Index parent);

  std::vector<Node> nodes_;
  std::vector<Index> leaf_of_;
};

}  // namespace mesamis::detail::surface
