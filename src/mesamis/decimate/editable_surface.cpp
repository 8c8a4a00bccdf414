// SPDX-License-Identifier: Apache-2.0
#include "mesamis/decimate/editable_surface.h"

#include <algorithm>
#include <span>

#include "mesamis/surface/half_edges.h"

namespace mesamis::detail::decimate {

EditableSurface::EditableSurface(std::size_t points, const std::vector<Triangle>& triangles)
    : opposite_(3 * triangles.size(), kNoIndex), leaving_(points, kNoIndex), is_inner_(points, 0) {
  corners_.reserve(opposite_.size());
  std::vector<Index> count(points, 0);
  for (const Triangle& t : triangles) {
    for (const Index p : t) {
      leaving_[p] = static_cast<Index>(corners_.size());
      ++count[p];
      corners_.push_back(p);
    }
  }
  const auto half_edges = sorted_half_edges(triangles, points);
  for_each_edge(half_edges, [this](std::span<const HalfEdge> edge) {
    if (edge.size() != 2) return;
    link(3 * edge[0].triangle + edge[0].corner, 3 * edge[1].triangle + edge[1].corner);
  });
  for (std::size_t p = 0; p < points; ++p) {
    Index first = leaving_[p];
    if (first == kNoIndex) continue;
    // Clockwise to the rim, or once around.
    for (Index before = opposite_[first]; before != kNoIndex; before = opposite_[first]) {
      first = next(before);
      if (first == leaving_[p]) break;
    }
    leaving_[p] = first;
    Index fan = 0;
    for_each_leaving(static_cast<Index>(p), [&fan](Index) { ++fan; });
    is_inner_[p] = opposite_[first] != kNoIndex && fan == count[p] ? 1 : 0;
  }
}

void EditableSurface::link(Index a, Index b) {
  if (a != kNoIndex) opposite_[a] = b;
  if (b != kNoIndex) opposite_[b] = a;
}

bool EditableSurface::may_collapse(Index h) const {
  const Index left = from(previous(h)), right = from(previous(opposite(h)));
  const Index a = from(h), b = to(h);
  if (left == right) return false;
  // Of the points around both ends only the two opposite ones may be common.
  int common = 0, at_left = 0, at_right = 0;
  bool splits = false;
  for_each_leaving(b, [&](Index g) {
    const auto see = [&](Index q) {
      if (q == a || q == left || q == right) return;
      for_each_leaving(a, [&](Index k) { common += to(k) == q ? 1 : 0; });
    };
    see(to(g));
    if (rotated(g) == kNoIndex) see(from(previous(g)));
  });
  for_each_leaving(left, [&](Index) { ++at_left; });
  for_each_leaving(right, [&](Index) { ++at_right; });
  splits = (is_inner(left) && at_left <= 3) || (is_inner(right) && at_right <= 3);
  return common == 0 && !splits;
}

void EditableSurface::collapse(Index h) {
  const Index o = opposite(h);
  const Index removed = from(h), kept = to(h);
  const Index left = from(previous(h)), right = from(previous(o));
  for_each_leaving(removed, [&](Index g) { corners_[g] = kept; });
  // The sides of the two triangles that are left, from the kept point's triangles and from the removed's.
  const Index left_kept = opposite_[next(h)], left_moved = opposite_[previous(h)];
  const Index right_kept = opposite_[previous(o)], right_moved = opposite_[next(o)];
  link(left_kept, left_moved);
  link(right_kept, right_moved);
  if (is_inner(kept) || leaving_[kept] == next(h)) leaving_[kept] = left_moved;
  if (leaving_[left] == previous(h)) leaving_[left] = left_kept;
  if (leaving_[right] == previous(o)) leaving_[right] = right_moved;
  leaving_[removed] = kNoIndex;
  for (const Index t : {h / 3, o / 3}) {
    for (Index i = 0; i < 3; ++i) corners_[3 * t + i] = opposite_[3 * t + i] = kNoIndex;
  }
}

}  // namespace mesamis::detail::decimate
