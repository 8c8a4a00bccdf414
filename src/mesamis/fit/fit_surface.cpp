// SPDX-License-Identifier: Apache-2.0
#include "mesamis/fit/fit_surface.h"

#include <utility>

#include "mesamis/base/error.h"
#include "mesamis/base/parallel.h"
#include "mesamis/fit/bending.h"
#include "mesamis/fit/image_edge.h"
#include "mesamis/fit/surface_moves.h"

namespace mesamis {
namespace {

/// Pulls each point to the edge that it sees, or else to where it began.
void aim(const FollowSpace& space, const FitPoints& points, const FitOptions& options,
         const std::vector<Vec3>& start, const TriMesh& now, const Neighbors& neighbors,
         Springs& springs) {
  const std::vector<Vec3> normals = smoothed_normals(now, neighbors);
  parallel_for(start.size(), [&](std::size_t p) {
    ImageEdge edge;
    const bool looks = springs.held[p] == 0 && points.contrast[p] != 0 && points.on_curve[p] == 0;
    if (looks) {
      edge = find_image_edge(space, now.points[p], normals[p], points.contrast[p], options.reach);
    }
    const double stay = (1 - edge.weight) * options.start;
    const Vec3 seen = now.points[p] + (edge.distance * space.voxel()) * normals[p];
    springs.weight[p] = edge.weight + stay;
    springs.goal[p] = (1 / springs.weight[p]) * (edge.weight * seen + stay * start[p]);
  });
}

}  // namespace

TriMesh fit_surface(TriMesh surface, const SplineImage& image, const FitPoints& points,
                    const FitOptions& options) {
  require_sound(surface);
  const std::size_t n = surface.points.size();
  if (points.contrast.size() != n || points.on_curve.size() != n) {
    throw InputError("fit: expected an entry for each point of the surface");
  }
  const FollowSpace space(image, 1);
  const Neighbors neighbors(surface);
  const Umbrella umbrella(neighbors, points.on_curve);
  Springs springs{std::vector<double>(n), std::vector<Vec3>(n), std::vector<char>(n)};
  parallel_for(n,
               [&](std::size_t p) { springs.held[p] = space.on_box(surface.points[p]) ? 1 : 0; });
  TriMesh now = surface;
  for (int round = 0; round < options.rounds; ++round) {
    aim(space, points, options, surface.points, now, neighbors, springs);
    now.points = relax(umbrella, springs, options.bending, std::move(now.points));
  }
  std::vector<Vec3> shifts(n);
  for (std::size_t p = 0; p < n; ++p) {
    shifts[p] = space.within_box(surface.points[p], now.points[p] - surface.points[p]);
  }
  return moved_without_folds(space, surface, std::move(shifts));
}

}  // namespace mesamis
