// SPDX-License-Identifier: Apache-2.0
#include "mesamis/surface/box_tree.h"

#include <utility>

#include "mesamis/base/parallel.h"

namespace mesamis::detail::surface {

std::size_t halve(std::span<PlacedItem> items) {
  Box centers = kNoBox;
  for (const PlacedItem& i : items) centers = united(centers, {i.center, i.center});
  const Vec3 e = centers.extent();
  const int axis = e.x >= e.y && e.x >= e.z ? 0 : e.y >= e.z ? 1 : 2;
  const std::size_t half = items.size() / 2;
  std::nth_element(items.begin(), items.begin() + static_cast<std::ptrdiff_t>(half), items.end(),
                   [axis](const PlacedItem& a, const PlacedItem& b) {
                     const double x = a.center[axis], y = b.center[axis];
                     return x != y ? x < y : a.item < b.item;
                   });
  return half;
}

BoxTree::BoxTree(std::span<const Box> boxes) {
  if (boxes.empty()) return;
  std::vector<PlacedItem> items(boxes.size());
  parallel_for(items.size(), [&](std::size_t i) {
    items[i] = {boxes[i].lo + boxes[i].hi, static_cast<Index>(i)};
  });
  nodes_.resize(2 * boxes.size() - 1);
  leaf_of_.resize(boxes.size());
  build(boxes, items, 0, kNoIndex);
}

/// Makes the node of the items and, halved at the median of their centres, its children: n items
/// have 2 n - 1 nodes.
void BoxTree::build(std::span<const Box> boxes, std::span<PlacedItem> items, Index place,
                    Index parent) {
  Node& node = nodes_[static_cast<std::size_t>(place)];
  node.parent = parent;
  if (items.size() == 1) {
    node.item = items[0].item;
    node.box = boxes[node.item];
    leaf_of_[node.item] = place;
    return;
  }
  const std::size_t half = halve(items);
  node.second = place + static_cast<Index>(2 * half);
  const auto build_half = [&](std::size_t child) {
    child == 0 ? build(boxes, items.first(half), place + 1, place)
               : build(boxes, items.subspan(half), node.second, place);
  };
  parallel_halves(items.size(), build_half);
  node.box = united(nodes_[place + 1].box, nodes_[node.second].box);
}

std::vector<BoxTree::NodePair> BoxTree::shares_of_pairs(std::size_t count) const {
  std::vector<NodePair> shares;
  if (nodes_.empty()) return shares;
  shares.push_back({0, 0});
  while (shares.size() < count) {
    std::vector<NodePair> parts;
    bool any = false;
    for (const NodePair& share : shares) {
      if (nodes_[share[0]].item != kNoIndex || nodes_[share[1]].item != kNoIndex) {
        parts.push_back(share);
        continue;
      }
      any = true;
      for_each_part(share, [&](const NodePair& part) { parts.push_back(part); });
    }
    shares = std::move(parts);
    if (!any) break;
  }
  return shares;
}

void BoxTree::update(std::span<const Box> boxes) {
  for (std::size_t n = nodes_.size(); n-- > 0;) {  // children come after their parents
    Node& node = nodes_[n];
    node.box = node.item == kNoIndex ? united(nodes_[n + 1].box, nodes_[node.second].box)
                                     : boxes[node.item];
  }
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
