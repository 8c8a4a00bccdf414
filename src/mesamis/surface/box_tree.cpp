// SPDX-License-Identifier: Apache-2.0
#include "mesamis/surface/box_tree.h"

#include <numeric>

#include "mesamis/base/parallel.h"

namespace mesamis::detail::surface {
BoxTree::BoxTree(std::span<const Box> boxes) {
  if (boxes.empty()) return;
  std::vector<Index> items(boxes.size());
  std::iota(items.begin(), items.end(), 0);
  nodes_.resize(2 * boxes.size() - 1);
  leaf_of_.resize(boxes.size());
  build(boxes, items, 0, kNoIndex);
}

/// Makes the node of the items and, halved at the median of their centres, its children: n items
/// have 2 n - 1 nodes.
void BoxTree::build(std::span<const Box> boxes, std::span<Index> items, Index place, Index parent) {
  Node& node = nodes_[static_cast<std::size_t>(place)];
  node.parent = parent;
  Box whole = kNoBox, centers = kNoBox;
  for (const Index i : items) {
    whole = united(whole, boxes[i]);
    const Vec3 center = boxes[i].lo + boxes[i].hi;
    centers = united(centers, {center, center});
  }
  node.box = whole;
  if (items.size() == 1) {
    node.item = items[0];
    leaf_of_[items[0]] = place;
    return;
  }
  const Vec3 e = centers.extent();
  const int axis = e.x >= e.y && e.x >= e.z ? 0 : e.y >= e.z ? 1 : 2;
  const std::size_t half = items.size() / 2;
  std::nth_element(items.begin(), items.begin() + static_cast<std::ptrdiff_t>(half), items.end(),
                   [&](Index a, Index b) {
                     const double x = boxes[a].lo[axis] + boxes[a].hi[axis];
                     const double y = boxes[b].lo[axis] + boxes[b].hi[axis];
                     return x != y ? x < y : a < b;
                   });
  node.second = place + static_cast<Index>(2 * half);
  const auto build_half = [&](std::size_t child) {
    child == 0 ? build(boxes, items.first(half), place + 1, place)
               : build(boxes, items.subspan(half), node.second, place);
  };
  parallel_halves(items.size(), build_half);
}

void BoxTree::update(std::size_t i, const Box& box) {
  Index n = leaf_of_[i];
  nodes_[n].box = box;
  while ((n = nodes_[n].parent) != kNoIndex) {
    const Box whole = united(nodes_[n + 1].box, nodes_[nodes_[n].second].box);
    if (whole == nodes_[n].box) return;
    nodes_[n].box = whole;
  }
}

}  // namespace mesamis::detail::surface
