// SPDX-License-Identifier: Apache-2.0
#include "mesamis/surface/box_tree.h"

#include <numeric>

namespace mesamis::detail::surface {
BoxTree::BoxTree(std::span<const Box> boxes) {
  if (boxes.empty()) return;
  std::vector<Index> items(boxes.size());
  std::iota(items.begin(), items.end(), 0);
  nodes_.reserve(2 * boxes.size());
  leaf_of_.resize(boxes.size());
  build(boxes, items, kNoIndex);
}

/// Appends the node of the items and, halved at the median of their centres, its children.
void BoxTree::build(std::span<const Box> boxes, std::span<Index> items, Index parent) {
  const std::size_t node = nodes_.size();
  nodes_.push_back({kNoBox, parent, kNoIndex, kNoIndex});
  Box centers = kNoBox;
  for (const Index i : items) {
    nodes_[node].box = united(nodes_[node].box, boxes[i]);
    const Vec3 center = boxes[i].lo + boxes[i].hi;
    centers = united(centers, {center, center});
  }
  if (items.size() == 1) {
    nodes_[node].item = items[0];
    leaf_of_[items[0]] = static_cast<Index>(node);
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
  build(boxes, items.first(half), static_cast<Index>(node));
  nodes_[node].second = static_cast<Index>(nodes_.size());
  build(boxes, items.subspan(half), static_cast<Index>(node));
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
