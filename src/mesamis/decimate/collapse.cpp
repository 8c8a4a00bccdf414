// SPDX-License-Identifier: Apache-2.0
#include "mesamis/decimate/collapse.h"

#include <algorithm>
#include <cmath>

#include "mesamis/decimate/crease.h"

namespace mesamis::detail::decimate {
namespace {

/// By so much the creases of a neighbourhood may grow in a collapse: none appear where there are none.
constexpr double kMostCreases = 1.1;

Corners corners_at(const EditableSurface& surface, const std::vector<Vec3>& points, Index t) {
  const Triangle k = surface.triangle(t);
  return {points[k[0]], points[k[1]], points[k[2]]};
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
    for_each_side_at_kept(surface, collapse, [&](Index h, bool) { see(h); });
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
  if (collapse.moves) {
    return collapse.at_rim ? sum : sum + crease_at(first[0], first[1], now[n - 1], now[0]);
  }
  for_each_side_at_kept(surface, collapse, [&](Index h, bool is_first) {
    if (is_first) {
      see(h, first[0], first[1], now[0]);
    } else {
      see(h, last[0], last[2], now[n - 1]);
    }
  });
  return sum;
}

/// Whether creases grow by too much.
bool has_creases(const EditableSurface& surface, const std::vector<Vec3>& points,
                 const std::vector<Vec3>& normals, const Collapse& collapse,
                 const std::vector<Vec3>& now) {
  const double after = creases_after(surface, normals, collapse, now);
  return after > 0 && creases_grow(creases_before(surface, points, normals, collapse), after);
}

void start(Index h, Index removed, Index kept, const Vec3& place, const Vec3& before,
           Collapse& collapse) {
  collapse.half_edge = h;
  collapse.removed = removed;
  collapse.kept = kept;
  collapse.place = place;
  collapse.moves = place.x != before.x || place.y != before.y || place.z != before.z;
  collapse.faces.clear();
  collapse.outer.clear();
  collapse.after.clear();
}

/// @param g  leaves the point that changes.
void add_face(const EditableSurface& surface, const std::vector<Vec3>& points, Index g,
              Collapse& collapse) {
  const Index outer = EditableSurface::next(g);
  collapse.faces.push_back(g / 3);
  collapse.outer.push_back(outer);
  collapse.after.push_back(
      {collapse.place, points[surface.from(outer)], points[surface.to(outer)]});
}

}  // namespace

double flatness(const Corners& t) {
  const Vec3 a = t[1] - t[0], b = t[2] - t[1], c = t[0] - t[2];
  const double longest = std::max({dot(a, a), dot(b, b), dot(c, c)});
  const Vec3 n = cross(a, b);
  return longest > 0 ? dot(n, n) / (longest * longest) : 0;
}

double crease_at(const Vec3& from, const Vec3& to, const Vec3& left, const Vec3& right) {
  const double excess = kCrease - dot(left, right);
  if (!(excess > 0) || dot(left, left) == 0 || dot(right, right) == 0) return 0;
  return std::min(excess, kCrease - kSharpCrease) * norm(to - from);
}

bool creases_grow(double before, double after) {
  constexpr double kRounding = 1e-9;
  return after > kMostCreases * before + kRounding;
}

void describe(const EditableSurface& surface, const std::vector<Vec3>& points, Index h,
              const Vec3& place, Collapse& collapse) {
  start(h, surface.from(h), surface.to(h), place, points[surface.to(h)], collapse);
  const Index o = surface.opposite(h);
  collapse.at_rim = false;
  collapse.beside = {h / 3, o / 3};
  const auto go_round = [&](Index first, Index last) {
    for (Index g = surface.rotated(first); g != last; g = surface.rotated(g)) {
      add_face(surface, points, g, collapse);
    }
  };
  go_round(h, EditableSurface::next(o));
  if (collapse.moves) go_round(o, EditableSurface::next(h));
}

void describe_at_rim(const EditableSurface& surface, const std::vector<Vec3>& points, Index h,
                     Index removed, const Vec3& place, Collapse& collapse) {
  const bool is_first = surface.from(h) == removed;
  const Index kept = surface.other_end(h, removed);
  start(h, removed, kept, place, points[kept], collapse);
  collapse.at_rim = true;
  collapse.beside = {h / 3, kNoIndex};
  const auto go_round = [&](Index p) {
    surface.for_each_leaving(p, [&](Index g) {
      if (g / 3 != h / 3) add_face(surface, points, g, collapse);
    });
  };
  if (is_first && collapse.moves) go_round(kept);
  go_round(removed);
  if (!is_first && collapse.moves) go_round(kept);
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
    if (before > kFlattest && dot(normals[collapse.faces[i]], now[i]) < kMostTurned) return true;
  }
  for (const Corners& t : collapse.after) {
    if (flatness(t) < flattest) return true;
  }
  return creases && has_creases(surface, points, normals, collapse, now);
}

}  // namespace mesamis::detail::decimate
