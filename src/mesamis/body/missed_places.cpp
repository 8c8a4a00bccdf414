// SPDX-License-Identifier: Apache-2.0
#include "mesamis/body/missed_places.h"

#include <algorithm>
#include <cmath>

#include "mesamis/base/parallel.h"
#include "mesamis/surface/farthest.h"
#include "mesamis/surface/triangle_tree.h"

namespace mesamis::detail::body {
namespace {

/// Points of a triangle, its corners among them, at most so far apart along its sides.
std::vector<Vec3> points_on(const surface::Corners& t, double distance) {
  constexpr double kMostSteps = 1000;
  const double longest = std::max({norm(t[1] - t[0]), norm(t[2] - t[1]), norm(t[0] - t[2])});
  const int n = static_cast<int>(std::ceil(std::clamp(longest / distance, 1.0, kMostSteps)));
  std::vector<Vec3> points;
  points.reserve(static_cast<std::size_t>(n + 1) * static_cast<std::size_t>(n + 2) / 2);
  for (int i = 0; i <= n; ++i) {
    for (int j = 0; i + j <= n; ++j) {
      const double u = double(i) / n, v = double(j) / n;
      points.push_back((1 - u - v) * t[0] + u * t[1] + v * t[2]);
    }
  }
  return points;
}

}  // namespace

std::vector<Vec3> missed_places(const TriMesh& surface, const TriMesh& other, double tolerance) {
  // No point of a triangle is farther than 0.58 steps from one of its places.
  constexpr double kStep = 0.25, kFar = 0.85;
  constexpr std::size_t kTrianglesPerBlock = 512;
  const surface::TriangleTree tree(other);
  return parallel_collect<Vec3>(
      surface.triangles.size(), kTrianglesPerBlock,
      [&](std::size_t begin, std::size_t end, std::vector<Vec3>& found) {
        std::size_t hint = 0;
        for (std::size_t t = begin; t < end; ++t) {
          const auto corners = surface::corners_of(surface, surface.triangles[t]);
          const double farthest =
              surface::farthest_distance(corners, tree, {tolerance, tolerance}, hint);
          if (farthest <= tolerance) continue;
          for (const Vec3& p : points_on(corners, kStep * tolerance)) {
            const double distance = std::sqrt(tree.squared_distance_to(p, hint));
            if (distance > kFar * tolerance) found.push_back(p);
          }
        }
      });
}

}  // namespace mesamis::detail::body
