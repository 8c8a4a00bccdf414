// SPDX-License-Identifier: Apache-2.0
#include "mesamis/decimate/fan_height.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace mesamis::detail::decimate {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr int kMostPoints = 40;

/// A point seen along the normal: its place in the view, and its height.
struct Seen {
  double x, y, height;
};

double turn(const Seen& a, const Seen& b) { return a.x * b.y - a.y * b.x; }

Seen from_to(const Seen& a, const Seen& b) { return {b.x - a.x, b.y - a.y, b.height - a.height}; }

double turn(const Seen& a, const Seen& b, const Seen& c) {
  return turn(from_to(a, b), from_to(a, c));
}

using Edge = std::array<int, 2>;

/// What one rim encloses, twice: the triangles before a collapse and those after.
class View {
 public:
  View(const EditableSurface& surface, const std::vector<Vec3>& points, const Collapse& collapse) {
    const auto n = static_cast<int>(collapse.faces.size());
    is_seen_ = n + 4 <= kMostPoints && !collapse.at_rim;
    if (!is_seen_) return;
    Vec3 normal{0, 0, 0};
    for (const Corners& t : collapse.after) normal += cross(t[1] - t[0], t[2] - t[0]);
    normal = unit_or_zero(normal);
    const Vec3 side = perpendicular_to(normal);
    const Vec3 up = cross(normal, side);
    const auto see = [&](const Vec3& p) {
      const Vec3 d = p - collapse.place;
      seen_[static_cast<std::size_t>(count_)] = {dot(d, side), dot(d, up), dot(d, normal)};
      return count_++;
    };
    if (collapse.moves) {
      for (const Corners& t : collapse.after) see(t[1]);

      int turned = 0;  // the triangles around the point that goes
      const Index right =
          surface.from(EditableSurface::previous(surface.opposite(collapse.half_edge)));
      while (turned < n && surface.from(collapse.outer[static_cast<std::size_t>(turned)]) != right)
        ++turned;
      const int gone = see(points[collapse.removed]), kept = see(points[collapse.kept]);
      const int place = see(collapse.place);
      old_inner_ = {gone, kept};
      old_inner_count_ = 2;
      for (int i = 0; i < n; ++i) {
        const int j = (i + 1) % n;
        add_old(i < turned ? gone : kept, i, j);
        add_new(place, i, j);
        new_edges_[static_cast<std::size_t>(new_count_++)] = {place, i};
        if (i <= turned) add_old_edge(gone, i);
        if (i >= turned) add_old_edge(kept, i);
      }
      add_old_edge(kept, 0);
      add_old_edge(gone, kept);
      add_old(gone, kept, 0);
      add_old(kept, gone, turned % n);
      new_inner_ = place;
    } else {
      const int kept = see(collapse.place);
      for (const Corners& t : collapse.after) see(t[1]);
      see(collapse.after.back()[2]);
      const int gone = see(points[collapse.removed]);
      old_inner_ = {gone, gone};
      old_inner_count_ = 1;
      for (int i = 0; i <= n + 1; ++i) {
        add_old(gone, i, (i + 1) % (n + 2));
        add_old_edge(gone, i);
        if (i >= 1 && i <= n) add_new(kept, i, i + 1);
        if (i >= 2 && i <= n) new_edges_[static_cast<std::size_t>(new_count_++)] = {kept, i};
      }
    }
  }

  double height() const {
    if (!is_seen_ || !lies_flat()) return kInfinity;
    double greatest = 0;
    for (int i = 0; i < old_inner_count_; ++i) {
      const int p = old_inner_[static_cast<std::size_t>(i)];
      greatest = std::max(greatest, above(p, new_, new_triangles_));
    }
    if (new_inner_ >= 0) greatest = std::max(greatest, above(new_inner_, old_, old_triangles_));
    for (int i = 0; i < old_count_; ++i) {
      for (int j = 0; j < new_count_; ++j) {
        greatest = std::max(greatest, crossing(old_edges_[static_cast<std::size_t>(i)],
                                               new_edges_[static_cast<std::size_t>(j)]));
      }
    }
    return greatest;
  }

 private:
  using Triple = std::array<int, 3>;
  using Triples = std::array<Triple, kMostPoints>;

  const Seen& at(int i) const { return seen_[static_cast<std::size_t>(i)]; }
  void add_old(int a, int b, int c) {
    old_[static_cast<std::size_t>(old_triangles_++)] = {a, b, c};
  }
  void add_new(int a, int b, int c) {
    new_[static_cast<std::size_t>(new_triangles_++)] = {a, b, c};
  }
  void add_old_edge(int a, int b) { old_edges_[static_cast<std::size_t>(old_count_++)] = {a, b}; }

  /// Whether no triangle is turned over, and the rim goes round the inner point once: then both cover
  /// the same part of the view, once.
  bool lies_flat() const {
    for (int i = 0; i < old_triangles_; ++i) {
      const Triple& t = old_[static_cast<std::size_t>(i)];
      if (!(turn(at(t[0]), at(t[1]), at(t[2])) > 0)) return false;
    }
    for (int i = 0; i < new_triangles_; ++i) {
      const Triple& t = new_[static_cast<std::size_t>(i)];
      if (!(turn(at(t[0]), at(t[1]), at(t[2])) > 0)) return false;
    }
    // Around the place, or around the point that goes.
    const bool placed = new_inner_ >= 0;
    const int inner = placed ? new_inner_ : old_inner_[0];
    const Triples& fan = placed ? new_ : old_;
    const int n = placed ? new_triangles_ : old_triangles_;
    int rounds = 0;
    for (int i = 0; i < n; ++i) {
      const Triple& t = fan[static_cast<std::size_t>(i)];
      const double a = at(t[1]).y - at(inner).y, b = at(t[2]).y - at(inner).y;
      if (a < 0 && b >= 0) ++rounds;
    }
    return rounds == 1;
  }

  /// How far a point lies above or below the triangles.
  double above(int point, const Triples& triangles, int count) const {
    const Seen& p = at(point);
    double best = -kInfinity, height = kInfinity;
    for (int i = 0; i < count; ++i) {
      const Triple& t = triangles[static_cast<std::size_t>(i)];
      const Seen &a = at(t[0]), &b = at(t[1]), &c = at(t[2]);
      const double at_a = turn(p, b, c), at_b = turn(p, c, a), at_c = turn(p, a, b);
      const double whole = at_a + at_b + at_c, least = std::min({at_a, at_b, at_c}) / whole;
      if (least <= best) continue;
      best = least;
      height = std::abs((at_a * a.height + at_b * b.height + at_c * c.height) / whole - p.height);
      if (least >= 0) break;
    }
    return best > -1e-9 ? height : kInfinity;
  }

  /// How far two edges lie apart where they cross; 0 where they do not.
  double crossing(const Edge& e, const Edge& f) const {
    if (e[0] == f[0] || e[0] == f[1] || e[1] == f[0] || e[1] == f[1]) return 0;
    const Seen &a = at(e[0]), &b = at(e[1]), &c = at(f[0]), &d = at(f[1]);
    const double c_side = turn(a, b, c), d_side = turn(a, b, d);
    if ((c_side > 0) == (d_side > 0)) return 0;
    const double a_side = turn(c, d, a), b_side = turn(c, d, b);
    if ((a_side > 0) == (b_side > 0)) return 0;
    const double on_e = a_side / (a_side - b_side), on_f = c_side / (c_side - d_side);
    return std::abs(a.height + on_e * (b.height - a.height) - c.height -
                    on_f * (d.height - c.height));
  }

  bool is_seen_ = false;
  std::array<Seen, kMostPoints> seen_;
  int count_ = 0, old_triangles_ = 0, new_triangles_ = 0, old_count_ = 0, new_count_ = 0;
  Triples old_, new_;
  std::array<Edge, 2 * kMostPoints> old_edges_, new_edges_;
  std::array<int, 2> old_inner_{};
  int old_inner_count_ = 0, new_inner_ = -1;
};

}  // namespace

double fan_height(const EditableSurface& surface, const std::vector<Vec3>& points,
                  const Collapse& collapse) {
  return View(surface, points, collapse).height();
}

}  // namespace mesamis::detail::decimate
