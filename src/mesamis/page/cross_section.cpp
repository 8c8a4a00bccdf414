// SPDX-License-Identifier: Apache-2.0
#include "mesamis/page/cross_section.h"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "mesamis/surface/measure.h"

namespace mesamis::detail::page {
namespace {

using Edge = std::pair<Index, Index>;

/// What a triangle leaves on the plane.
struct Crossing {
  std::array<Edge, 2> edges;
  std::array<std::array<double, 2>, 2> ends;
};

std::vector<Crossing> crossings_of(const TriMesh& surface, const std::vector<Vec3>& points) {
  std::vector<Crossing> crossings;
  for (const Triangle& t : surface.triangles) {
    Crossing crossing;
    std::size_t found = 0;
    for (std::size_t e = 0; e < 3 && found < 2; ++e) {
      // From the lower index on: both triangles of an edge find the same point.
      const auto [i, j] = std::minmax(t[e], t[(e + 1) % 3]);
      const Vec3 &a = points[static_cast<std::size_t>(i)], &b = points[static_cast<std::size_t>(j)];
      if ((a.z < 0) == (b.z < 0)) continue;
      const Vec3 at = a + (a.z / (a.z - b.z)) * (b - a);
      crossing.edges[found] = {i, j};
      crossing.ends[found++] = {at.x, at.y};
    }
    if (found == 2) crossings.push_back(crossing);
  }
  return crossings;
}

/// Joins crossings that end at the same edge of the surface.
class Chains {
 public:
  explicit Chains(std::vector<Crossing> crossings)
      : crossings_(std::move(crossings)), used_(crossings_.size(), false) {
    for (std::size_t n = 0; n < crossings_.size(); ++n) {
      for (const Edge& edge : crossings_[n].edges) at_.push_back({edge, n});
    }
    std::sort(at_.begin(), at_.end());
  }

  std::vector<PageLine> lines() {
    std::vector<PageLine> found;
    for (std::size_t n = 0; n < crossings_.size(); ++n) {
      if (used_[n]) continue;
      used_[n] = true;
      PageLine line{crossings_[n].ends[0], crossings_[n].ends[1]};
      walk(crossings_[n].edges[1], line);
      if (line.front() != line.back()) {  // open: its other part too
        std::reverse(line.begin(), line.end());
        walk(crossings_[n].edges[0], line);
      }
      found.push_back(std::move(line));
    }
    return found;
  }

 private:
  void walk(Edge edge, PageLine& line) {
    for (std::size_t next = unused(edge); next < crossings_.size(); next = unused(edge)) {
      used_[next] = true;
      const std::size_t far = crossings_[next].edges[0] == edge ? 1 : 0;
      line.push_back(crossings_[next].ends[far]);
      edge = crossings_[next].edges[far];
    }
  }

  /// A crossing at this edge that no line has; none: the number of crossings.
  std::size_t unused(const Edge& edge) const {
    auto at = std::lower_bound(at_.begin(), at_.end(), std::pair{edge, std::size_t{0}});
    for (; at != at_.end() && at->first == edge; ++at) {
      if (!used_[at->second]) return at->second;
    }
    return crossings_.size();
  }

  std::vector<Crossing> crossings_;
  std::vector<bool> used_;
  std::vector<std::pair<Edge, std::size_t>> at_;
};

}  // namespace

std::vector<PageLine> cross_section(const TriMesh& surface, const VoxelGrid& grid,
                                    const SlicePlane& plane) {
  std::vector<Vec3> points;
  points.reserve(surface.points.size());
  for (const Vec3& p : surface.points) points.push_back(to_page(grid, plane, p));
  return Chains(crossings_of(surface, points)).lines();
}

double middle_of(const std::vector<const TriMesh*>& surfaces, int axis) {
  std::vector<std::pair<double, double>> areas;  // where, and how much
  double all = 0;
  for (const TriMesh* surface : surfaces) {
    for (std::size_t t = 0; t < surface->triangles.size(); ++t) {
      double middle = 0;
      for (const Index n : surface->triangles[t]) {
        middle += surface->points[static_cast<std::size_t>(n)][axis];
      }
      const double area = triangle_area(*surface, t);
      areas.emplace_back(middle / 3, area);
      all += area;
    }
  }
  std::sort(areas.begin(), areas.end());
  double below = 0;
  for (const auto& [where, area] : areas) {
    below += area;
    if (2 * below >= all) return where;
  }
  return 0;
}

}  // namespace mesamis::detail::page
