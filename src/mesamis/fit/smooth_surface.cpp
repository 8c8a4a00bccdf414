// SPDX-License-Identifier: Apache-2.0
#include "mesamis/fit/smooth_surface.h"

#include <utility>

#include "mesamis/base/error.h"
#include "mesamis/base/parallel.h"
#include "mesamis/fit/bending.h"
#include "mesamis/fit/surface_moves.h"

namespace mesamis::detail::fit {

TriMesh smooth_surface(const TriMesh& surface, const VoxelGrid& grid,
                       const Links& links, const SmoothingOptions& options) {
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
