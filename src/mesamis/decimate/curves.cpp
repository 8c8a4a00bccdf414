// SPDX-License-Identifier: Apache-2.0
#include "mesamis/decimate/curves.h"

#include <algorithm>

#include "mesamis/decimate/crease.h"

namespace mesamis::detail::decimate {
namespace {

/// What an interface shows at the edges of a curve that a collapse changes: beyond the point that
/// goes, between both, and beyond the other.
struct Side {
  bool forward;                ///< whether its rim runs from the point that goes to the other
  std::array<Vec3, 3> before;  ///< normals
  std::array<Vec3, 2> after;   ///< at the first and the last
  std::array<Vec3, 2> beyond;  ///< mm
};

Side side_of(const EditableSurface& surface, const std::vector<Vec3>& points,
             const std::vector<Vec3>& normals, const Collapse& collapse) {
  const Index a = collapse.removed, b = collapse.kept;
  Side side;
  side.forward = surface.from(collapse.half_edge) == a;
  const Index at_a = side.forward ? surface.arriving_at_rim(a) : surface.leaving(a);
  const Index at_b = side.forward ? surface.leaving(b) : surface.arriving_at_rim(b);
  side.before = {normals[at_a / 3], normals[collapse.half_edge / 3], normals[at_b / 3]};
  side.beyond = {points[side.forward ? surface.from(at_a) : surface.to(at_a)],
                 points[side.forward ? surface.to(at_b) : surface.from(at_b)]};
  const Vec3 first = unit_normal(collapse.after.front()), last = unit_normal(collapse.after.back());
  side.after = side.forward ? std::array{last, first} : std::array{first, last};
  return side;
}

/// Of each point of a patch 1 if other patches have triangles there, too.
std::vector<char> points_around(const Patch& patch) {
  std::vector<char> shared(patch.points.size(), 0);
  for (const Triangle& t : patch.around) {
    for (const Index p : t) {
      const auto found = std::lower_bound(patch.points.begin(), patch.points.end(), p);
      if (found == patch.points.end() || *found != p) continue;
      shared[static_cast<std::size_t>(found - patch.points.begin())] = 1;
    }
  }
  return shared;
}

Index copies_of(const Interfaces& interfaces, Index point) {
  const auto& firsts = interfaces.first_copy;  // never falls
  const auto [begin, end] = std::equal_range(firsts.begin(), firsts.end(), firsts[point]);
  return static_cast<Index>(end - begin);
}

}  // namespace

Curves::Curves(const Interfaces& interfaces, const Patch& patch)
    : has_all_edges_(patch.points.size(), 0) {
  const auto end = static_cast<Index>(patch.points.size());
  for (Index p = 0; p < end; ++p) {
    const Index first = interfaces.first_copy[patch.points[p]];
    const bool is_copy = p > 0 && first == interfaces.first_copy[patch.points[p - 1]];
    first_copies_.push_back(is_copy ? first_copies_.back() : p);
    at_rim_.push_back(interfaces.at_rim[patch.points[p]]);
    may_go_.push_back(interfaces.within_curve[patch.points[p]]);
    touches_itself_.push_back(interfaces.touches_itself[patch.points[p]]);
  }
  const std::vector<char> shared = points_around(patch);
  for (Index p = 0; p < end; ++p) {
    if (first_copies_[p] != p) continue;
    Index here = 0;
    bool held = false, beside = false;
    for_each_copy(p, [&](Index q) {
      ++here;
      held |= patch.held[q] != 0;
      beside |= shared[q] != 0;
    });
    const bool all = here == copies_of(interfaces, patch.points[p]) && !beside;
    for_each_copy(p, [&](Index q) {
      has_all_edges_[q] = all ? 1 : 0;
      if (held || !all) may_go_[q] = 0;
    });
  }
}

std::vector<Index> Curves::half_edges_at(const EditableSurface& surface, Index h) const {
  std::vector<Index> found;
  const Index other = first_copies_[surface.to(h)];
  for_each_copy(surface.from(h), [&](Index copy) {
    if (surface.leaving(copy) == kNoIndex || surface.is_inner(copy)) return;
    const Index leaving = surface.leaving(copy), arriving = surface.arriving_at_rim(copy);
    if (first_copies_[surface.to(leaving)] == other) found.push_back(leaving);
    if (first_copies_[surface.from(arriving)] == other) found.push_back(arriving);
  });
  std::sort(found.begin(), found.end());
  return found;
}

bool Curves::has_edge(const EditableSurface& surface, Index a, Index b) const {
  bool found = false;
  for_each_copy(a, [&](Index copy) {
    surface.for_each_neighbor(copy,
                              [&](Index q) { found |= first_copies_[q] == first_copies_[b]; });
  });
  return found;
}

bool Curves::may_collapse(const EditableSurface& surface, const std::vector<Index>& half_edges,
                          Index removed) const {
  return std::all_of(half_edges.begin(), half_edges.end(), [&](Index h) {
    const Index a = copy_at(surface, h, removed);
    const Index b = surface.other_end(h, a), apex = surface.from(EditableSurface::previous(h));
    if (!surface.may_collapse_at_rim(h, a)) return false;
    bool joins = false;
    surface.for_each_neighbor(a, [&](Index q) {
      if (q == b || q == apex) return;
      joins |= !may_join(surface, b, q);
    });
    return !joins;
  });
}

bool bends_curve(const EditableSurface& surface, const std::vector<Vec3>& normals,
                 const Curves& curves, const Collapse& collapse) {
  const auto bends = [&](Index h, const Corners& now) {
    if (surface.opposite(h) != kNoIndex) return false;
    const std::vector<Index> all = curves.half_edges_at(surface, h);
    return std::any_of(all.begin(), all.end(), [&](Index g) {
      const bool same =
          curves.first_copies()[surface.from(g)] == curves.first_copies()[surface.from(h)];
      const Vec3 other = (same ? -1.0 : 1.0) * normals[g / 3];
      return g != h && dot(normals[h / 3], other) >= kCrease &&
             dot(unit_normal(now), other) < kCrease;
    });
  };
  for (std::size_t i = 0; i < collapse.faces.size(); ++i) {
    if (bends(collapse.outer[i], collapse.after[i])) return true;
  }
  bool any = false;
  if (!collapse.moves) {
    for_each_side_at_kept(surface, collapse, [&](Index h, bool is_first) {
      any |= bends(h, is_first ? collapse.after.front() : collapse.after.back());
    });
  }
  return any;
}

bool spoils_curve(const EditableSurface& surface, const std::vector<Vec3>& points,
                  const std::vector<Vec3>& normals, const std::vector<Collapse>& collapses) {
  std::vector<Side> sides;
  sides.reserve(collapses.size());
  for (const Collapse& c : collapses) sides.push_back(side_of(surface, points, normals, c));
  const Collapse& one = collapses[0];
  const Vec3 &a = points[one.removed], &b = points[one.kept];
  const auto [before_a, after_b] = sides[0].beyond;
  for (std::size_t j = 0; j < sides.size(); ++j) {
    for (std::size_t i = 0; i < j; ++i) {
      const double sign = sides[i].forward == sides[j].forward ? -1 : 1;
      const auto crease = [&](const Vec3& from, const Vec3& to, const Vec3& n, const Vec3& m) {
        return crease_at(from, to, n, sign * m);
      };
      const auto& was = sides[i].before;
      const auto& other = sides[j].before;
      double before = crease(before_a, a, was[0], other[0]) + crease(a, b, was[1], other[1]);
      double after = crease(before_a, one.place, sides[i].after[0], sides[j].after[0]);
      if (one.moves) {
        before += crease(b, after_b, was[2], other[2]);
        after += crease(one.place, after_b, sides[i].after[1], sides[j].after[1]);
      }
      if (creases_grow(before, after)) return true;
    }
  }
  return false;
}

}  // namespace mesamis::detail::decimate
