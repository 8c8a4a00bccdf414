// SPDX-License-Identifier: Apache-2.0
#include "mesamis/surface/split_edges.h"

#include <algorithm>
#include <array>
#include <utility>

#include "mesamis/surface/half_edges.h"

namespace mesamis {
namespace {

constexpr Index kWhole = -1;  // an edge that is not split

/// A triangle and the middles of its edges; edge i runs from corner i to the next.
struct SplitTriangle {
  Triangle corners;
  Triangle middles{kWhole, kWhole, kWhole};

  int count() const {
    return static_cast<int>(
        std::count_if(middles.begin(), middles.end(), [](Index n) { return n != kWhole; }));
  }
  void rotate() {
    std::rotate(corners.begin(), corners.begin() + 1, corners.end());
    std::rotate(middles.begin(), middles.begin() + 1, middles.end());
  }
};

class Splitter {
 public:
  Splitter(TriMesh& surface, double longest, const Vec3& unit)
      : surface_(surface), longest_(longest), unit_(unit) {}

  /// Splits every triangle's longest edge that is too long. @return false if there was none.
  bool round() {
    std::vector<SplitTriangle> split = find_middles();
    if (split.empty()) return false;
    std::vector<Triangle> triangles;
    triangles.reserve(2 * split.size());
    for (SplitTriangle& t : split) cut(t, triangles);
    surface_.triangles = std::move(triangles);
    return true;
  }

 private:
  double length(Index a, Index b) const {
    const Vec3 d = surface_.points[a] - surface_.points[b];
    return norm({d.x / unit_.x, d.y / unit_.y, d.z / unit_.z});
  }

  /// The corner from which the triangle's longest edge runs, or none if that is short enough.
  int longest_edge(const Triangle& t) const {
    int found = -1;
    double most = longest_;
    for (int i = 0; i < 3; ++i) {
      const double l =
          length(t[static_cast<std::size_t>(i)], t[static_cast<std::size_t>((i + 1) % 3)]);
      if (l > most) most = l, found = i;
    }
    return found;
  }

  /// Adds the points and tells the triangles of them; empty if nothing is to be split.
  std::vector<SplitTriangle> find_middles() {
    const auto edges = sorted_half_edges(surface_.triangles, surface_.points.size());
    std::vector<int> longest(surface_.triangles.size());
    for (std::size_t t = 0; t < longest.size(); ++t)
      longest[t] = longest_edge(surface_.triangles[t]);
    std::vector<SplitTriangle> split;
    for (const Triangle& t : surface_.triangles) split.push_back({t});
    const std::size_t before = surface_.points.size();
    for_each_edge(edges, [&](std::span<const HalfEdge> edge) {
      const bool asked = std::any_of(edge.begin(), edge.end(), [&](const HalfEdge& h) {
        return longest[static_cast<std::size_t>(h.triangle)] == h.corner;
      });
      if (!asked) return;
      const auto middle = static_cast<Index>(surface_.points.size());
      surface_.points.push_back(0.5 * (surface_.points[edge[0].lo] + surface_.points[edge[0].hi]));
      for (const HalfEdge& h : edge) {
        split[static_cast<std::size_t>(h.triangle)].middles[static_cast<std::size_t>(h.corner)] =
            middle;
      }
    });
    if (surface_.points.size() == before) split.clear();
    return split;
  }

  void cut(SplitTriangle& t, std::vector<Triangle>& out) const {
    const int count = t.count();
    const auto& [a, b, c] = t.corners;
    const auto& [ab, bc, ca] = t.middles;
    if (count == 0) {
      out.push_back(t.corners);
    } else if (count == 3) {
      out.insert(out.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    } else if (count == 1) {
      while (ab == kWhole) t.rotate();
      out.insert(out.end(), {{a, ab, c}, {ab, b, c}});
    } else {
      while (ca != kWhole) t.rotate();
      out.push_back({ab, b, bc});
      if (length(a, bc) < length(ab, c)) {
        out.insert(out.end(), {{a, ab, bc}, {a, bc, c}});
      } else {
        out.insert(out.end(), {{a, ab, c}, {ab, bc, c}});
      }
    }
  }

  TriMesh& surface_;
  double longest_;
  Vec3 unit_;
};

}  // namespace

TriMesh split_long_edges(TriMesh surface, double longest, const Vec3& unit) {
  require_sound(surface);
  Splitter splitter(surface, longest, unit);
  while (splitter.round()) {
  }
  return surface;
}

}  // namespace mesamis
