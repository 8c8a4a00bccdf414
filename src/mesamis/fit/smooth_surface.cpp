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

/// Of the weight of smoothness: that of the surface at which points stop that may not go as far.
constexpr double kShare = 1.0 / 16;

class Smoothing {
 public:
  Smoothing(const std::vector<Vec3>& start, const SurfaceSpace& space, Umbrella umbrella,
            const SmoothingOptions& options)
      : start_(start), space_(space), umbrella_(std::move(umbrella)), options_(options) {}

  /// From the start.
  std::vector<Vec3> shifts(double bending) const {
    Springs springs = springs_at(space_, start_, 1);
    springs.least_step = kLeastStep * space_.voxel();
    std::vector<Vec3> now = start_;
    for (int round = 0; round < options_.rounds; ++round) {
      now = relax(umbrella_, springs, bending, std::move(now));
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
  const std::vector<Vec3>& start = surface.points;
  const std::vector<Vec3> shifts = smoothing.shifts(options.bending);
  SurfaceMover mover(space, surface, Unfolded::kInFile);
  if (!mover.move(start, shifts)) {
    mover.move(start, smoothing.shifts(kShare * options.bending));
    const std::vector<Vec3> less = mover.points();
    std::vector<Vec3> rest(shifts.size());
    parallel_for(rest.size(), [&](std::size_t p) { rest[p] = shifts[p] + (start[p] - less[p]); });
    mover.move(less, std::move(rest));
  }
  return mover.take_surface();
}

}  // namespace mesamis::detail::fit
