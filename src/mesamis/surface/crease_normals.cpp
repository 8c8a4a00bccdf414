// SPDX-License-Identifier: Apache-2.0
#include "mesamis/surface/crease_normals.h"

#include <cmath>
#include <numbers>

#include "mesamis/surface/disjoint_sets.h"
#include "mesamis/surface/half_edges.h"

namespace mesamis::detail::surface {
namespace {

/// Normals whose lengths are twice the areas.
std::vector<Vec3> area_normals(const TriMesh& surface) {
  std::vector<Vec3> normals;
  normals.reserve(surface.triangles.size());
  for (const Triangle& t : surface.triangles) {
    const auto at = [&](std::size_t n) { return surface.points[static_cast<std::size_t>(t[n])]; };
    normals.push_back(cross(at(1) - at(0), at(2) - at(0)));
  }
  return normals;
}

/// Corners of triangles, numbered 3 t + i, that share a normal.
DisjointSets smooth_corners(const TriMesh& surface, const std::vector<Vec3>& normals,
                            double angle_deg) {
  const double least = std::cos(angle_deg * std::numbers::pi / 180);
  DisjointSets sets(3 * surface.triangles.size());
  const auto half_edges = sorted_half_edges(surface.triangles, surface.points.size());
  for_each_edge(half_edges, [&](std::span<const HalfEdge> edge) {
    if (edge.size() != 2) return;
    const Vec3& a = normals[static_cast<std::size_t>(edge[0].triangle)];
    const Vec3& b = normals[static_cast<std::size_t>(edge[1].triangle)];
    if (dot(a, b) < least * norm(a) * norm(b)) return;
    sets.unite(edge[0].corner_at_lo(), edge[1].corner_at_lo());
    sets.unite(edge[0].corner_at_hi(), edge[1].corner_at_hi());
  });
  return sets;
}

}  // namespace

std::vector<std::array<Vec3, 3>> crease_normals(const TriMesh& surface, double angle_deg) {
  const std::vector<Vec3> of_triangle = area_normals(surface);
  const auto set = smooth_corners(surface, of_triangle, angle_deg).numbers();
  std::vector<Vec3> sums(static_cast<std::size_t>(set.count));
  for (std::size_t corner = 0; corner < set.of_item.size(); ++corner) {
    sums[static_cast<std::size_t>(set.of_item[corner])] += of_triangle[corner / 3];
  }
  std::vector<std::array<Vec3, 3>> normals(surface.triangles.size());
  for (std::size_t corner = 0; corner < set.of_item.size(); ++corner) {
    normals[corner / 3][corner % 3] =
        unit_or_zero(sums[static_cast<std::size_t>(set.of_item[corner])]);
  }
  return normals;
}

}  // namespace mesamis::detail::surface
