// SPDX-License-Identifier: Apache-2.0
#include "mesamis/decimate/collapse.h"

#include <algorithm>
#include <cmath>

#include "mesamis/decimate/crease.h"

namespace mesamis::detail::decimate {
namespace {

/// Cosine of the angle by which a triangle may turn, 75 degrees.
constexpr double kTurn = 0.2588;
/// By so much the creases of a neighbourhood may grow in a collapse: none appear where there are none.
constexpr double kMostCreases = 1.1;
/// Height over longest side, squared.
constexpr double kFlattest = 0.01 * 0.01;

double flatness(const Corners& t) {
  const Vec3 a = t[1] - t[0], b = t[2] - t[1], c = t[0] - t[2];
  const double longest = std::max({dot(a, a), dot(b, b), dot(c, c)});
  const Vec3 n = cross(a, b);
  return longest > 0 ? dot(n, n) / (longest * longest) : 0;
}

Corners corners_at(const EditableSurface& surface, const std::vector<Vec3>& points, Index t) {
  const Triangle k = surface.triangle(t);
  return {points[k[0]], points[k[1]], points[k[2]]};
}

/// The share of an edge in the creases of a surface: its length, times by how much it is sharper than
/// edges may be.
double crease_at(const Vec3& from, const Vec3& to, const Vec3& left, const Vec3& right) {
  const double excess = kCrease - dot(left, right);
  if (!(excess > 0) || dot(left, left) == 0 || dot(right, right) == 0) return 0;
  return excess * norm(to - from);
}

double creases_before(const EditableSurface& surface, const std::vector<Vec3>& points,
                      const std::vector<Vec3>& normals, const Collapse& collapse) {
  double sum = 0;
  const auto see = [&](Index h) {
    const Index o = surface.opposite(h);
    if (o == kNoIndex) return;
    sum +=
        crease_at(points[surface.from(h)], points[surface.to(h)], normals[h / 3], normals[o / 3]);
  };
  surface.for_each_leaving(collapse.removed, see);
  if (collapse.moves) {
    surface.for_each_leaving(collapse.kept, [&](Index h) {
      if (surface.to(h) != collapse.removed) see(h);
    });
  } else {
    see(EditableSurface::next(collapse.half_edge));
    see(EditableSurface::previous(surface.opposite(collapse.half_edge)));
  }
  for (const Index h : collapse.outer) see(h);
  return sum;
}

double creases_after(const EditableSurface& surface, const std::vector<Vec3>& normals,
                     const Collapse& collapse, const std::vector<Vec3>& now) {
  double sum = 0;
  const std::size_t n = now.size();
  const auto see = [&](Index h, const Vec3& from, const Vec3& to, const Vec3& own) {
    const Index o = surface.opposite(h);
    if (o != kNoIndex) sum += crease_at(from, to, own, normals[o / 3]);
  };
  for (std::size_t i = 0; i < n; ++i) {
    const Corners& t = collapse.after[i];
    see(collapse.outer[i], t[1], t[2], now[i]);
    if (i + 1 < n) sum += crease_at(t[0], t[2], now[i], now[i + 1]);
  }
  const Corners &first = collapse.after[0], &last = collapse.after[n - 1];
  if (collapse.moves) return sum + crease_at(first[0], first[1], now[n - 1], now[0]);
  see(EditableSurface::next(collapse.half_edge), first[0], first[1], now[0]);
  see(EditableSurface::previous(surface.opposite(collapse.half_edge)), last[0], last[2],
      now[n - 1]);
  return sum;
}

/// Whether creases grow by too much.
bool has_creases(const EditableSurface& surface, const std::vector<Vec3>& points,
                 const std::vector<Vec3>& normals, const Collapse& collapse,
                 const std::vector<Vec3>& now) {
  constexpr double kRounding = 1e-9;
  const double after = creases_after(surface, normals, collapse, now);
  if (after == 0) return false;
  return after > kMostCreases * creases_before(surface, points, normals, collapse) + kRounding;
}

}  // namespace

void describe(const EditableSurface& surface, const std::vector<Vec3>& points, Index h,
              const Vec3& place, Collapse& collapse) {
  collapse.half_edge = h;
  collapse.removed = surface.from(h);
  collapse.kept = surface.to(h);
  collapse.place = place;
  const Vec3& kept = points[collapse.kept];
  collapse.moves = place.x != kept.x || place.y != kept.y || place.z != kept.z;
  const Index o = surface.opposite(h);
  collapse.gone = {h / 3, o / 3};
  collapse.faces.clear();
  collapse.outer.clear();
  collapse.after.clear();
  const auto go_round = [&](Index first, Index last) {
    for (Index g = surface.rotated(first); g != last; g = surface.rotated(g)) {
      const Index outer = EditableSurface::next(g);
      collapse.faces.push_back(g / 3);
      collapse.outer.push_back(outer);
      collapse.after.push_back({place, points[surface.from(outer)], points[surface.to(outer)]});
    }
  };
  go_round(h, EditableSurface::next(o));
  if (collapse.moves) go_round(o, EditableSurface::next(h));
}

bool spoils_shape(const EditableSurface& surface, const std::vector<Vec3>& points,
                  const std::vector<Vec3>& normals, const Collapse& collapse, bool creases) {
  static thread_local std::vector<Vec3> now;
  now.clear();
  double flattest = kFlattest;
  for (std::size_t i = 0; i < collapse.faces.size(); ++i) {
    now.push_back(unit_normal(collapse.after[i]));
    const double before = flatness(corners_at(surface, points, collapse.faces[i]));
    flattest = std::min(flattest, before);
    // The normals of needles say little.
    if (before > kFlattest && dot(normals[collapse.faces[i]], now[i]) < kTurn) return true;
  }
  for (const Corners& t : collapse.after) {
    if (flatness(t) < flattest) return true;
  }
  return creases && has_creases(surface, points, normals, collapse, now);
}

}  // namespace mesamis::detail::decimate
