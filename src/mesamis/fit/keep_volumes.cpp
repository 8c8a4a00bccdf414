// SPDX-License-Identifier: Apache-2.0
#include "mesamis/fit/keep_volumes.h"

#include <algorithm>
#include <utility>

#include "mesamis/base/parallel.h"
#include "mesamis/fit/surface_moves.h"
#include "mesamis/surface/normals.h"

namespace mesamis::detail::fit {
namespace {

using Sides = std::span<const std::array<Index, 2>>;

std::size_t material_count(Sides sides) {
  Index last = 0;
  for (const auto& pair : sides) last = std::max({last, pair[0], pair[1]});
  return static_cast<std::size_t>(last) + 1;
}

/// Adds what a function tells of each triangle to the material behind it, and times `in_front` to
/// the one in front.
template <class Function>
std::vector<double> sums_of_materials(const TriMesh& surface, Sides sides, double in_front,
                                      Function&& function) {
  std::vector<double> sums(material_count(sides), 0);
  for (std::size_t t = 0; t < sides.size(); ++t) {
    const Triangle& k = surface.triangles[t];
    const Vec3 &a = surface.points[k[0]], &b = surface.points[k[1]], &c = surface.points[k[2]];
    const double value = function(a, b, c);
    if (sides[t][0] >= 0) sums[sides[t][0]] += value;
    if (sides[t][1] >= 0) sums[sides[t][1]] += in_front * value;
  }
  return sums;
}

/// Of each material, but for a constant where its boundary is open on the box, mm^3.
std::vector<double> volumes_of(const TriMesh& surface, Sides sides) {
  return sums_of_materials(surface, sides, -1, [](const Vec3& a, const Vec3& b, const Vec3& c) {
    return dot(a, cross(b, c)) / 6;
  });
}

std::vector<double> areas_of(const TriMesh& surface, Sides sides) {
  return sums_of_materials(surface, sides, 1, [](const Vec3& a, const Vec3& b, const Vec3& c) {
    return norm(cross(b - a, c - a)) / 2;
  });
}

}  // namespace

TriMesh keep_volumes(const MovedBoundaries& boundaries, const VoxelGrid& grid) {
  const auto& [before, now, sides, on_curve] = boundaries;
  constexpr int kSteps = 4;
  const SurfaceSpace space(grid, 1);
  std::vector<std::array<Index, 2>> sides_of(now.points.size(), {0, 0});
  for (std::size_t t = 0; t < sides.size(); ++t) {
    for (const Index p : now.triangles[t]) sides_of[p] = sides[t];
  }
  const std::vector<double> wanted = volumes_of(before, sides);
  TriMesh moved = now;
  for (int step = 0; step < kSteps; ++step) {
    const std::vector<double> volumes = volumes_of(moved, sides), areas = areas_of(moved, sides);
    std::vector<double> distance(volumes.size(), 0);
    for (std::size_t m = 1; m < distance.size(); ++m) {
      if (areas[m] > 0) distance[m] = (wanted[m] - volumes[m]) / areas[m];
    }
    const auto of = [&](Index m) { return m > 0 ? distance[m] : 0.0; };
    const std::vector<Vec3> normals = vertex_normals(moved);
    parallel_for(moved.points.size(), [&](std::size_t p) {
      if (boundaries.on_curve[p] != 0 || space.on_box(moved.points[p])) return;
      const Vec3 move = (of(sides_of[p][0]) - of(sides_of[p][1])) * normals[p];
      moved.points[p] += space.within_box(moved.points[p], move);
    });
  }
  std::vector<Vec3> shifts(now.points.size());
  for (std::size_t p = 0; p < shifts.size(); ++p) shifts[p] = moved.points[p] - now.points[p];
  return moved_without_folds(space, now, std::move(shifts));
}

}  // namespace mesamis::detail::fit
