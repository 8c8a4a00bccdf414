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

int EditableSurface::triangles_at(Index point) const {
  int count = 0;
  for_each_leaving(point, [&count](Index) { ++count; });
  return count;
}

Index EditableSurface::arriving_at_rim(Index point) const {
  Index last = kNoIndex;
  for_each_leaving(point, [&last](Index h) { last = h; });
  return previous(last);
}

bool EditableSurface::may_collapse(Index h) const {
  const Index left = from(previous(h)), right = from(previous(opposite(h)));
  const Index a = from(h), b = to(h);
  if (left == right) return false;
  // Of the points around both ends only the two opposite ones may be common.
  int common = 0;
  for_each_neighbor(b, [&](Index q) {
    if (q == a || q == left || q == right) return;
    for_each_leaving(a, [&](Index k) { common += to(k) == q ? 1 : 0; });
  });
  const bool splits =
      (is_inner(left) && triangles_at(left) <= 3) || (is_inner(right) && triangles_at(right) <= 3);
  return common == 0 && !splits;
}

bool EditableSurface::may_flip(Index h) const {
  const Index a = from(h), b = to(h);
  const Index c = from(previous(h)), d = from(previous(opposite(h)));
  if (c == d || triangles_at(a) <= 3 || triangles_at(b) <= 3) return false;
  bool joined = false;
  for_each_neighbor(c, [&](Index q) { joined |= q == d; });
  return !joined;
}

void EditableSurface::flip(Index h) {
  const Index o = opposite(h);
  const Index h_next = next(h), h_previous = previous(h), o_next = next(o),
              o_previous = previous(o);
  const Index a = from(h), b = to(h), c = from(h_previous), d = from(o_previous);
  const Index beside_bc = opposite(h_next), beside_ca = opposite(h_previous),
              beside_ad = opposite(o_next), beside_db = opposite(o_previous);
  corners_[h] = d, corners_[h_next] = c, corners_[h_previous] = a;
  corners_[o] = c, corners_[o_next] = d, corners_[o_previous] = b;
  const auto put = [this](Index k, Index beside) {
    opposite_[k] = beside;
    if (beside != kNoIndex) opposite_[beside] = k;
  };
  put(h_next, beside_ca);
  put(h_previous, beside_ad);
  put(o_next, beside_db);
  put(o_previous, beside_bc);
  // The first of those that leave a point stays the first.
  if (leaving_[a] == h || leaving_[a] == o_next) leaving_[a] = h_previous;
  if (leaving_[b] == o || leaving_[b] == h_next) leaving_[b] = o_previous;
  if (leaving_[c] == h_previous) leaving_[c] = h_next;
  if (leaving_[d] == o_previous) leaving_[d] = o_next;
}

void EditableSurface::flip_back(Index h) {
  for (int turn = 0; turn < 3; ++turn) flip(h);  // four are a whole turn
}

bool EditableSurface::may_collapse_at_rim(Index h, Index removed) const {
  const Index at_removed = from(h) == removed ? previous(h) : next(h);
  if (opposite(at_removed) == kNoIndex) return false;
  const Index a = from(h), b = to(h), apex = from(previous(h));
  int common = 0;
  for_each_neighbor(b, [&](Index q) {
    if (q == a || q == apex) return;
    for_each_neighbor(a, [&](Index k) { common += k == q ? 1 : 0; });
  });
  return common == 0;
}

/// Removes the triangle of a half-edge, two of whose corners have become one, and joins what lies
/// beside its other two sides.
void EditableSurface::remove_triangle_at(Index h) {
  const Index after = opposite_[next(h)], before = opposite_[previous(h)];
  link(after, before);
  const Index apex = corners_[previous(h)];
  if (leaving_[apex] == previous(h)) leaving_[apex] = after;
  const Index t = h / 3;
  for (Index i = 0; i < 3; ++i) corners_[3 * t + i] = opposite_[3 * t + i] = kNoIndex;
}

void EditableSurface::collapse(Index h) {
  const Index o = opposite(h), removed = from(h), kept = to(h);
  for_each_leaving(removed, [&](Index g) { corners_[g] = kept; });
  if (is_inner(kept) || leaving_[kept] == next(h)) leaving_[kept] = opposite_[previous(h)];
  leaving_[removed] = kNoIndex;
  remove_triangle_at(h);
  remove_triangle_at(o);
}

void EditableSurface::collapse_at_rim(Index h, Index removed) {
  const bool is_last = to(h) == removed;
  const Index kept = other_end(h, removed);
  for_each_leaving(removed, [&](Index g) { corners_[g] = kept; });
  if (is_last) {
    leaving_[kept] = leaving_[removed];
  } else if (leaving_[kept] == next(h)) {
    leaving_[kept] = opposite_[previous(h)];
  }
  leaving_[removed] = kNoIndex;
  remove_triangle_at(h);
}

}  // namespace mesamis::detail::decimate
