// SPDX-License-Identifier: Apache-2.0
#include "mesamis/decimate/flip.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "mesamis/decimate/collapse.h"

namespace mesamis::detail::decimate {
namespace {

/// So much of the bends may be left.
constexpr double kSmoother = 0.97;

/// What bends at an edge and the four sides around it.
struct Bends {
  double bends = 0;    // mm
  double creases = 0;  // mm, see crease_at()

  void add(const Vec3& from, const Vec3& to, const Vec3& left, const Vec3& right) {
    bends += norm(to - from) * (1 - dot(left, right));
    creases += crease_at(from, to, left, right);
  }
};

/// Before and after, triangles stand over the same part of a plane: they are farthest apart where the
/// edges cross.
double height_of(const Vec3& from, const Vec3& to, const Vec3& left, const Vec3& right) {
  const Vec3 up = unit_or_zero(cross(to - from, left - right));
  const auto is_seen = [&up](const Vec3& a, const Vec3& b, const Vec3& c) {
    return dot(cross(b - a, c - a), up) > 0;
  };
  const bool are_seen = is_seen(from, to, left) && is_seen(to, from, right) &&
                        is_seen(right, left, from) && is_seen(left, right, to);
  return are_seen ? std::abs(dot(from - right, up)) : std::numeric_limits<double>::infinity();
}

}  // namespace

Flip describe_flip(const EditableSurface& surface, const std::vector<Vec3>& points, Index h) {
  const Index o = surface.opposite(h);
  const Index left = surface.from(EditableSurface::previous(h)),
              right = surface.from(EditableSurface::previous(o));
  const auto turned = [&points](Index k, Index first, Index second, Index third) {
    const auto at = static_cast<std::size_t>(k % 3);
    Corners t;
    t[at] = points[first];
    t[(at + 1) % 3] = points[second];
    t[(at + 2) % 3] = points[third];
    return t;
  };
  return {h,
          {h / 3, o / 3},
          {turned(h, right, left, surface.from(h)), turned(o, left, right, surface.to(h))},
          height_of(points[surface.from(h)], points[surface.to(h)], points[left], points[right])};
}

bool smooths(const EditableSurface& surface, const std::vector<Vec3>& points,
             const std::vector<Vec3>& normals, const Flip& flip) {
  const Index h = flip.half_edge, o = surface.opposite(h);
  const Vec3 &n = normals[flip.faces[0]], &m = normals[flip.faces[1]];
  const Vec3 n_after = unit_normal(flip.after[0]), m_after = unit_normal(flip.after[1]);
  const auto turns = [&](const Vec3& after) {
    return std::min(dot(after, n), dot(after, m)) < kMostTurned;
  };
  if (turns(n_after) || turns(m_after)) return false;
  Bends before, after;
  before.add(points[surface.from(h)], points[surface.to(h)], n, m);
  after.add(points[surface.from(EditableSurface::previous(h))],
            points[surface.from(EditableSurface::previous(o))], n_after, m_after);
  const auto see_side = [&](Index side, const Vec3& own, const Vec3& own_after) {
    const Index other = surface.opposite(side);
    if (other == kNoIndex) return;
    const Vec3 &from = points[surface.from(side)], &to = points[surface.to(side)];
    before.add(from, to, own, normals[other / 3]);
    after.add(from, to, own_after, normals[other / 3]);
  };
  see_side(EditableSurface::next(h), n, m_after);
  see_side(EditableSurface::previous(h), n, n_after);
  see_side(EditableSurface::next(o), m, n_after);
  see_side(EditableSurface::previous(o), m, m_after);
  if (!(after.bends < kSmoother * before.bends)) {
    return false;
  }
  double flattest = kFlattest;
  for (const Index t : flip.faces) {
    const Triangle k = surface.triangle(t);
    flattest = std::min(flattest, flatness({points[k[0]], points[k[1]], points[k[2]]}));
  }
  return std::min(flatness(flip.after[0]), flatness(flip.after[1])) >= flattest;
}

}  // namespace mesamis::detail::decimate
