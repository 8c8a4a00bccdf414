// SPDX-License-Identifier: Apache-2.0
#include "mesamis/body/missed_places.h"

#include <cmath>

#include "mesamis/base/parallel.h"
#include "mesamis/body/triangle_lattice.h"
#include "mesamis/surface/farthest.h"
#include "mesamis/surface/triangle_tree.h"

namespace mesamis::detail::body {
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
          visit_lattice(corners, kStep * tolerance, [&](const Vec3& p, const auto&) {
            const double distance = std::sqrt(tree.squared_distance_to(p, hint));
            if (distance > kFar * tolerance) found.push_back(p);
          });
        }
      });
}

}  // namespace mesamis::detail::body
