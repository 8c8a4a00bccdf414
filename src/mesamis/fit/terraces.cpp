// SPDX-License-Identifier: Apache-2.0
#include "mesamis/fit/terraces.h"

#include <algorithm>
#include <utility>

#include "mesamis/base/parallel.h"

namespace mesamis::detail::fit {
namespace {

constexpr double kBending = 8, kWeight = 4;
constexpr double kMostFreedom = 5000;  // K
constexpr double kTurn = 0.16;  // radians per edge at which K is 1: that of an edge of 90 degrees
constexpr int kSweeps = 33;     // of normals: terraces of up to ten edges vanish
constexpr int kRings = 3;       // around edges and small shapes
constexpr int kRounds = 3;
constexpr double kMostMoved = 0.4;  // of the distance between slices

/// How far the normals turn from each point to its neighbours, of unit vectors; the greatest around.
std::vector<double> turns_around(const TriMesh& surface, const Neighbors& neighbors) {
  const std::vector<Vec3> normals = smoothed_normals(surface, neighbors, kSweeps);
  std::vector<double> turns(normals.size(), 0);
  parallel_for(turns.size(), [&](std::size_t p) {
    const std::size_t begin = neighbors.start[p], end = neighbors.start[p + 1];
    for (std::size_t n = begin; n < end; ++n) {
      turns[p] += norm(normals[neighbors.points[n]] - normals[p]);
    }
    if (end > begin) turns[p] /= static_cast<double>(end - begin);
  });
  for (int ring = 0; ring < kRings; ++ring) turns = greatest_around(neighbors, turns);
  return turns;
}

}  // namespace

double most_moved_by_terraces(const SurfaceSpace& space) {
  return space.has_thick_slices() ? kMostMoved * space.longest_side() : 0;
}

std::vector<Vec3> without_terraces(const SurfaceSpace& space, const TriMesh& surface,
                                   const Neighbors& neighbors, Springs springs) {
  const std::vector<Vec3>& start = surface.points;
  if (!space.has_thick_slices()) return start;
  const std::vector<Vec3> normals = smoothed_normals(surface, neighbors);
  const std::vector<double> turns = turns_around(surface, neighbors);
  std::vector<double> between(start.size());
  parallel_for(start.size(), [&](std::size_t p) {
    between[p] = space.between_slices(start[p], normals[p]);
    const double turn = turns[p] / kTurn, cubed = turn * turn * turn;
    const double freedom = cubed * kMostFreedom > 1 ? 1 / cubed : kMostFreedom;
    springs.weight[p] *= kWeight / (1 + freedom * between[p]);
  });
  springs.goal = start;
  const Umbrella umbrella(neighbors, links_along_curves(neighbors, springs.held));
  std::vector<Vec3> now = start;
  for (int round = 0; round < kRounds; ++round) {
    if (round > 0) {
      parallel_for(start.size(), [&](std::size_t p) { springs.goal[p] += start[p] - now[p]; });
    }
    now = relax(umbrella, springs, kBending, std::move(now));
  }
  std::vector<Vec3> result = start;
  const double shortest = space.shortest_side() / space.voxel();
  parallel_for(start.size(), [&](std::size_t p) {
    if (springs.held[p] != 0) return;
    result[p] += space.step_to(now[p], start[p], kMostMoved * shortest * between[p]);
  });
  return result;
}

}  // namespace mesamis::detail::fit
