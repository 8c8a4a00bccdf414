// SPDX-License-Identifier: Apache-2.0
#include "mesamis/fit/fit_surface.h"

#include <utility>

#include "mesamis/base/error.h"
#include "mesamis/base/parallel.h"
#include "mesamis/fit/bending.h"
#include "mesamis/fit/image_edge.h"
#include "mesamis/fit/surface_moves.h"

namespace mesamis::detail::fit {
namespace {

/// The rounds of fit_surface().
class Fit {
 public:
  Fit(const TriMesh& start, const SplineImage& image, const FitPoints& points,
      const FitOptions& options)
      : space_(image, 1),
        start_(start),
        points_(points),
        options_(options),
        neighbors_(start),
        umbrella_(neighbors_, points.on_curve),
        now_(start),
        springs_(springs_at(space_, start.points, 0)) {}

  void round() {
    aim();
    now_.points = relax(umbrella_, springs_, options_.bending, std::move(now_.points));
  }

  /// The start with its points where they are now, as far as that is possible.
  TriMesh surface() const {
    std::vector<Vec3> shifts(now_.points.size());
    for (std::size_t p = 0; p < shifts.size(); ++p) {
      shifts[p] = space_.within_box(start_.points[p], now_.points[p] - start_.points[p]);
    }
    return moved_without_folds(space_, start_, std::move(shifts));
  }

 private:
  bool looks(std::size_t p) const {
    return springs_.held[p] == 0 && points_.contrast[p] != 0 && points_.on_curve[p] == 0;
  }

  /// Pulls each point to the edge that it sees, or else to where it began.
  void aim() {
    const std::vector<Vec3> normals = smoothed_normals(now_, neighbors_);
    parallel_for(now_.points.size(), [&](std::size_t p) {
      ImageEdge edge;
      if (looks(p)) {
        edge = find_image_edge(space_, now_.points[p], normals[p], points_.contrast[p],
                               options_.reach);
      }
      const double stay = (1 - edge.weight) * options_.start;
      const Vec3 seen = now_.points[p] + (edge.distance * space_.voxel()) * normals[p];
      springs_.weight[p] = edge.weight + stay;
      springs_.goal[p] = (1 / springs_.weight[p]) * (edge.weight * seen + stay * start_.points[p]);
    });
  }

  FollowSpace space_;
  const TriMesh& start_;
  const FitPoints& points_;
  const FitOptions& options_;
  Neighbors neighbors_;
  Umbrella umbrella_;
  TriMesh now_;
  Springs springs_;
};

}  // namespace

TriMesh fit_surface(const TriMesh& surface, const SplineImage& image, const FitPoints& points,
                    const FitOptions& options) {
  require_sound(surface);
  const std::size_t n = surface.points.size();
  if (points.contrast.size() != n || points.on_curve.size() != n) {
    throw InputError("fit: expected an entry for each point of the surface");
  }
  Fit fit(surface, image, points, options);
  for (int round = 0; round < options.rounds; ++round) fit.round();
  return fit.surface();
}

}  // namespace mesamis::detail::fit
