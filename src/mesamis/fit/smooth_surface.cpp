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
namespace {

class Smoothing {
 public:
  Smoothing(const std::vector<Vec3>& start, const SurfaceSpace& space, Umbrella umbrella,
            const SmoothingOptions& options)
      : start_(start), space_(space), umbrella_(std::move(umbrella)), options_(options) {}

  /// From the start.
  std::vector<Vec3> shifts() const {
    Springs springs = springs_at(space_, start_, 1);
    std::vector<Vec3> now = start_;
    for (int round = 0; round < options_.rounds; ++round) {
      now = relax(umbrella_, springs, options_.bending, std::move(now));
      parallel_for(now.size(), [&](std::size_t p) { springs.goal[p] += start_[p] - now[p]; });
    }
    std::vector<Vec3> shifts(now.size());
    parallel_for(now.size(), [&](std::size_t p) {
      shifts[p] = space_.step_to(now[p], start_[p], options_.reach);
    });
    return shifts;
  }

 private:
  const std::vector<Vec3>& start_;
  const SurfaceSpace& space_;
  Umbrella umbrella_;
  const SmoothingOptions& options_;
};

}  // namespace

SmoothingOptions smoothing_of_labels(const VoxelGrid& grid) {
  constexpr double kShareOfSlice = 0.85;
  const double thick = grid.longest_side() / grid.shortest_side();
  SmoothingOptions options;
  options.bending *= thick * thick;
  options.rounds -= static_cast<int>(std::lround(2 * std::min(thick - 1, 1.0)));
  options.reach = std::max(options.reach, kShareOfSlice * grid.longest_side() / grid.voxel_size());
  return options;
}

TriMesh smooth_surface(const TriMesh& surface, const VoxelGrid& grid, const Links& links,
                       const SmoothingOptions& options) {
  require_sound(surface);
  const Neighbors neighbors(surface);
  if (links.size() != neighbors.points.size()) {
    throw InputError("smoothing: expected an entry for each neighbour of each point");
  }
  const SurfaceSpace space(grid, 1);
  const Smoothing smoothing(surface.points, space, Umbrella(neighbors, links), options);
  constexpr int kMostMoves = 6;
  std::vector<Vec3> goals = smoothing.shifts();
  parallel_for(goals.size(), [&](std::size_t p) { goals[p] += surface.points[p]; });
  SurfaceMover mover(space, surface, Unfolded::kInFile);
  bool arrived = false;  // where others have moved, most of what was taken back may go on
  for (int move = 0; move < kMostMoves && !arrived; ++move) {
    std::vector<Vec3> rest(goals.size());
    parallel_for(rest.size(), [&](std::size_t p) { rest[p] = goals[p] - mover.points()[p]; });
    arrived = mover.move(mover.points(), std::move(rest));
  }
  return mover.take_surface();
}

}  // namespace mesamis::detail::fit
