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

/// How much more than others the goals of each part count, where a round leaves it these volumes: so
/// much that a rod keeps half of its width.
std::vector<double> weights_of_parts(const BoundaryParts& parts, const std::vector<double>& left) {
  constexpr double kLeast = 1e-3;
  std::vector<double> weights(parts.volumes.size(), 1);
  for (std::size_t p = 1; p < weights.size(); ++p) {
    const double width = std::sqrt(std::max(kLeast, left[p] / parts.volumes[p]));
    if (parts.volumes[p] > 0) weights[p] = std::max(1.0, 1 / width - 1);
  }
  return weights;
}

class Smoothing {
 public:
  Smoothing(const RoughBoundaries& rough, const SurfaceSpace& space, Umbrella umbrella,
            const SmoothingOptions& options)
      : rough_(rough),
        start_(rough.surface.points),
        space_(space),
        umbrella_(std::move(umbrella)),
        options_(options) {}

  std::vector<Vec3> places() const {
    Springs springs = springs_at(space_, start_, 1);
    std::vector<Vec3> now = start_;
    for (int round = 0; round < options_.rounds; ++round) {
      now = relax(umbrella_, springs, options_.bending, std::move(now));
      parallel_for(now.size(), [&](std::size_t p) { springs.goal[p] += start_[p] - now[p]; });
      if (round == 0 && rough_.parts != nullptr) restart_lost_parts(now, springs);
    }
    parallel_for(now.size(), [&](std::size_t p) {
      now[p] = start_[p] + space_.step_to(now[p], start_[p], options_.reach);
    });
    return now;
  }

 private:
  void restart_lost_parts(const std::vector<Vec3>& now, Springs& springs) const {
    const BoundaryParts& parts = *rough_.parts;
    const TriMesh surface{now, rough_.surface.triangles};
    const std::vector<double> weights =
        weights_of_parts(parts, enclosed_volumes(surface, parts.sides));
    for (std::size_t t = 0; t < parts.sides.size(); ++t) {
      for (const Index part : parts.sides[t]) {
        if (part <= 0 || !(weights[part] > 1)) continue;
        for (const Index p : surface.triangles[t]) {
          springs.weight[p] = std::max(springs.weight[p], weights[part]);
          springs.goal[p] = start_[p];
        }
      }
    }
  }

  const RoughBoundaries& rough_;
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

std::vector<Vec3> smooth_places(const RoughBoundaries& rough, const VoxelGrid& grid,
                                const SmoothingOptions& options) {
  require_sound(rough.surface);
  const Neighbors neighbors(rough.surface);
  if (rough.links.size() != neighbors.points.size()) {
    throw InputError("smoothing: expected an entry for each neighbour of each point");
  }
  const SurfaceSpace space(grid, 1);
  return Smoothing(rough, space, Umbrella(neighbors, rough.links), options).places();
}

TriMesh moved_to(const TriMesh& surface, const VoxelGrid& grid, const std::vector<Vec3>& places) {
  constexpr int kMostMoves = 6;
  const SurfaceSpace space(grid, 1);
  SurfaceMover mover(space, surface, Unfolded::kInFile);
  bool arrived = false;  // where others have moved, most of what was taken back may go on
  for (int move = 0; move < kMostMoves && !arrived; ++move) {
    std::vector<Vec3> rest(places.size());
    parallel_for(rest.size(), [&](std::size_t p) { rest[p] = places[p] - mover.points()[p]; });
    arrived = mover.move(mover.points(), std::move(rest));
  }
  return mover.take_surface();
}

}  // namespace mesamis::detail::fit
