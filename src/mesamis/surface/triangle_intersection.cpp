// SPDX-License-Identifier: Apache-2.0
#include "mesamis/surface/triangle_intersection.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "mesamis/surface/exact_predicates.h"
#include "mesamis/surface/half_edges.h"
#include "mesamis/surface/triangle_tree.h"

namespace mesamis::detail::surface {
namespace {

/// An axis along which the triangle has an area, the first to be tried that of the largest; -1: it
/// has none.
int axis_with_area(const Corners& t) {
  const Vec3 n = cross(t[1] - t[0], t[2] - t[0]);
  const double x = std::abs(n.x), y = std::abs(n.y), z = std::abs(n.z);
  const int largest = x >= y && x >= z ? 0 : y >= z ? 1 : 2;
  for (const int axis : {largest, (largest + 1) % 3, (largest + 2) % 3}) {
    if (orientation_along(axis, t[0], t[1], t[2]) != 0) return axis;
  }
  return -1;
}

/// p in the triangle's plane: inside, or on its border?
bool plane_point_in(int axis, const Vec3& p, const Corners& t) {
  const int turn = orientation_along(axis, t[0], t[1], t[2]);
  for (std::size_t i = 0; i < 3; ++i) {
    if (turn * orientation_along(axis, t[i], t[(i + 1) % 3], p) < 0) return false;
  }
  return true;
}

/// Is c, on the line through a and b, between them?
bool between(int axis, const Vec3& a, const Vec3& b, const Vec3& c) {
  const int s = (axis + 1) % 3, t = (axis + 2) % 3;
  return std::min(a[s], b[s]) <= c[s] && c[s] <= std::max(a[s], b[s]) &&
         std::min(a[t], b[t]) <= c[t] && c[t] <= std::max(a[t], b[t]);
}

using Segment = std::array<Vec3, 2>;

/// Two closed segments in one plane.
bool plane_segments_meet(int axis, const Segment& s, const Segment& t) {
  const auto& [a, b] = s;
  const auto& [c, d] = t;
  const int abc = orientation_along(axis, a, b, c), abd = orientation_along(axis, a, b, d);
  const int cda = orientation_along(axis, c, d, a), cdb = orientation_along(axis, c, d, b);
  if (abc * abd < 0 && cda * cdb < 0) return true;
  return (abc == 0 && between(axis, a, b, c)) || (abd == 0 && between(axis, a, b, d)) ||
         (cda == 0 && between(axis, c, d, a)) || (cdb == 0 && between(axis, c, d, b));
}

bool plane_segment_meets(int axis, const Vec3& p, const Vec3& q, const Corners& t) {
  if (plane_point_in(axis, p, t)) return true;
  for (std::size_t i = 0; i < 3; ++i) {
    if (plane_segments_meet(axis, {p, q}, {t[i], t[(i + 1) % 3]})) return true;
  }
  return false;
}

/// Closed segment and closed triangle. One without area meets none.
bool segment_meets(const Vec3& p, const Vec3& q, const Corners& t) {
  const int at_p = orientation(t[0], t[1], t[2], p), at_q = orientation(t[0], t[1], t[2], q);
  if (at_p * at_q > 0) return false;
  if (at_p == 0 || at_q == 0) {
    const int axis = axis_with_area(t);
    if (axis < 0) return false;
    if (at_p == 0 && at_q == 0) return plane_segment_meets(axis, p, q, t);
    return plane_point_in(axis, at_p == 0 ? p : q, t);
  }
  int lowest = 1, highest = -1;
  for (std::size_t i = 0; i < 3; ++i) {
    const int side = orientation(p, q, t[i], t[(i + 1) % 3]);
    lowest = std::min(lowest, side);
    highest = std::max(highest, side);
  }
  return lowest >= 0 || highest <= 0;
}

/// All corners of s on one side of the plane of t, none on it.
bool apart(const Corners& s, const Corners& t) {
  const int side = orientation(t[0], t[1], t[2], s[0]);
  return side != 0 && side == orientation(t[0], t[1], t[2], s[1]) &&
         side == orientation(t[0], t[1], t[2], s[2]);
}

/// No common corner: a side of one meets the other.
bool strangers_meet(const Corners& s, const Corners& t) {
  if (apart(s, t) || apart(t, s)) return false;
  for (std::size_t i = 0; i < 3; ++i) {
    if (segment_meets(s[i], s[(i + 1) % 3], t) || segment_meets(t[i], t[(i + 1) % 3], s)) {
      return true;
    }
  }
  return false;
}

/// s[0] = t[0] is the common corner: whatever else they share ends on the side opposite to it.
bool fans_meet(const Corners& s, const Corners& t) {
  return segment_meets(s[1], s[2], t) || segment_meets(t[1], t[2], s);
}

/// s[0], s[1] is the common side, a and b the other corners: folded onto each other?
bool folded(const Corners& s, const Vec3& b) {
  if (orientation(s[0], s[1], s[2], b) != 0) return false;
  const int axis = axis_with_area(s);
  return axis >= 0 &&
         orientation_along(axis, s[0], s[1], s[2]) == orientation_along(axis, s[0], s[1], b);
}

Corners corners_from(std::span<const Vec3> points, const Triangle& t, std::size_t first) {
  return {points[t[first]], points[t[(first + 1) % 3]], points[t[(first + 2) % 3]]};
}

/// As intersect(), for two triangles with areas; the corners of each must differ.
bool share_a_place(std::span<const Vec3> points, const Triangle& s, const Triangle& t) {
  std::array<std::size_t, 3> in_s{}, in_t{};  // corners in common
  std::size_t common = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      if (s[i] != t[j]) continue;
      in_s[common] = i;
      in_t[common] = j;
      ++common;
    }
  }
  if (common == 0) return strangers_meet(corners_from(points, s, 0), corners_from(points, t, 0));
  if (common == 1) {
    return fans_meet(corners_from(points, s, in_s[0]), corners_from(points, t, in_t[0]));
  }
  if (common == 3) return true;
  // Corners 0, 1 of s in turn are common; the third is opposite.
  const std::size_t s_apex = 3 - in_s[0] - in_s[1], t_apex = 3 - in_t[0] - in_t[1];
  return folded(corners_from(points, s, (s_apex + 1) % 3), points[t[t_apex]]);
}

}  // namespace

bool has_area(std::span<const Vec3> points, const Triangle& t) {
  return axis_with_area(corners_from(points, t, 0)) >= 0;
}

bool intersect(std::span<const Vec3> points, const Triangle& s, const Triangle& t) {
  if (is_degenerate(s) || is_degenerate(t)) return false;
  // Most pairs are told apart by their planes: what is rarely needed comes last.
  return share_a_place(points, s, t) && has_area(points, s) && has_area(points, t);
}

}  // namespace mesamis::detail::surface
