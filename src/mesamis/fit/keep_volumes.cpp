// SPDX-License-Identifier: Apache-2.0
#include "mesamis/fit/keep_volumes.h"

#include <algorithm>
#include <utility>

#include "mesamis/base/error.h"
#include "mesamis/base/parallel.h"
#include "mesamis/fit/boundary_parts.h"
#include "mesamis/fit/surface_moves.h"
#include "mesamis/surface/measure.h"

namespace mesamis::detail::fit {
namespace {

/// How much each material gains if its boundary moves outwards by a unit times the shares, mm^2.
std::vector<double> areas_of(const TriMesh& surface, Sides sides,
                             const std::vector<double>& share) {
  return sums_of_materials(sides, 1, [&](std::size_t t) {
    const auto [a, b, c] = surface.triangles[t];
    return triangle_area(surface, t) * (share[a] + share[b] + share[c]) / 3;
  });
}

/// How far points move with their boundary: from 0 on curves to 1 some rings of neighbours away.
std::vector<double> shares_of_points(const Neighbors& neighbors,
                                     const std::vector<char>& on_curve) {
  constexpr int kRings = 6;
  std::vector<double> near(on_curve.begin(), on_curve.end());
  for (int ring = 1; ring < kRings; ++ring) {
    const std::vector<double> around = greatest_around(neighbors, near);
    parallel_for(near.size(),
                 [&](std::size_t p) { near[p] = std::max(near[p], around[p] - 1.0 / kRings); });
  }
  std::vector<double> share(near.size());
  parallel_for(near.size(), [&](std::size_t p) {
    const double far = 1 - near[p];
    share[p] = far * far * (3 - 2 * far);
  });
  return share;
}

}  // namespace

std::vector<Vec3> keep_volumes(const ObjectBoundaries& boundaries, const VoxelGrid& grid) {
  const auto& [now, sides, on_curve, wanted, first] = boundaries;
  constexpr int kSteps = 4;
  constexpr double kMostVoxels = 0.4;
  if (!first.empty() && first.size() != now.points.size()) {
    throw InputError("volumes: expected a shift for each point");
  }
  const SurfaceSpace space(grid, 1);
  std::vector<std::array<Index, 2>> sides_of(now.points.size(), {0, 0});
  for (std::size_t t = 0; t < sides.size(); ++t) {
    for (const Index p : now.triangles[t]) sides_of[p] = sides[t];
  }
  const Neighbors neighbors(now);
  const std::vector<double> share = shares_of_points(neighbors, on_curve);
  const double most = kMostVoxels * space.voxel();
  std::vector<double> gone(std::min(wanted.size(), material_count(sides)), 0);  // by each boundary
  TriMesh moved = now;
  for (std::size_t p = 0; p < first.size(); ++p) moved.points[p] += first[p];
  for (int round = 0; round < kSteps; ++round) {
    const std::vector<double> volumes = enclosed_volumes(moved, sides),
                              areas = areas_of(moved, sides, share);
    std::vector<double> step(gone.size(), 0);
    for (std::size_t m = 1; m < step.size(); ++m) {
      if (!(areas[m] > 0)) continue;
      const double goal = gone[m] + (wanted[m] - volumes[m]) / areas[m];
      step[m] = std::clamp(goal, -most, most) - gone[m];
      gone[m] += step[m];
    }
    const auto of = [&](Index m) { return m > 0 && m < std::ssize(step) ? step[m] : 0.0; };
    const std::vector<Vec3> normals = smoothed_normals(moved, neighbors, on_curve);
    parallel_for(moved.points.size(), [&](std::size_t p) {
      if (share[p] == 0 || space.on_box(moved.points[p])) return;
      const double distance = of(sides_of[p][0]) - of(sides_of[p][1]);
      const Vec3 move = (share[p] * distance) * normals[p];
      moved.points[p] += space.within_box(moved.points[p], move);
    });
  }
  std::vector<Vec3> shifts(now.points.size());
  for (std::size_t p = 0; p < shifts.size(); ++p) shifts[p] = moved.points[p] - now.points[p];
  return shifts;
}

}  // namespace mesamis::detail::fit
