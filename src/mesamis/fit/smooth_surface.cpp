// SPDX-License-Identifier: Apache-2.0
#include "mesamis/fit/smooth_surface.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "mesamis/base/error.h"
#include "mesamis/base/parallel.h"
#include "mesamis/fit/bending.h"
#include "mesamis/fit/surface_moves.h"

namespace mesamis::detail::fit {

SmoothingOptions smoothing_of_labels(const VoxelGrid& grid) {
  constexpr double kShareOfSlice = 0.85;
  const double longest = std::max({grid.spacing.x, grid.spacing.y, grid.spacing.z});
  const double thick = longest / grid.shortest_side();
  SmoothingOptions options;
  options.bending *= thick * thick;
  options.rounds -= static_cast<int>(std::lround(2 * std::min(thick - 1, 1.0)));
  options.reach = std::max(options.reach, kShareOfSlice * longest / grid.voxel_size());
  return options;
}

TriMesh smooth_surface(const TriMesh& surface, const VoxelGrid& grid, const Links& links,
                       const SmoothingOptions& options) {
  require_sound(surface);
  const std::vector<Vec3>& start = surface.points;
  const SurfaceSpace space(grid, 1);
  const Neighbors neighbors(surface);
  if (links.size() != neighbors.points.size()) {
    throw InputError("smoothing: expected an entry for each neighbour of each point");
  }
  const Umbrella umbrella(neighbors, links);
  Springs springs = springs_at(space, start, 1);
  std::vector<Vec3> now = start;
  for (int round = 0; round < options.rounds; ++round) {
    now = relax(umbrella, springs, options.bending, std::move(now));
    parallel_for(start.size(), [&](std::size_t p) { springs.goal[p] += start[p] - now[p]; });
  }
  std::vector<Vec3> shifts(start.size());
  parallel_for(start.size(),
               [&](std::size_t p) { shifts[p] = space.step_to(now[p], start[p], options.reach); });
  return moved_without_folds(space, surface, std::move(shifts));
}

}  // namespace mesamis::detail::fit
