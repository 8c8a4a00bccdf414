// SPDX-License-Identifier: Apache-2.0
#include "mesamis/fit/fit_surface.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "mesamis/base/error.h"
#include "mesamis/base/parallel.h"
#include "mesamis/fit/bending.h"
#include "mesamis/fit/surface_moves.h"
#include "mesamis/surface/self_intersections.h"

namespace mesamis::detail::fit {
namespace {

/// The rounds of fit_surface().
class Fit {
 public:
  Fit(const TriMesh& start, Neighbors neighbors, const SplineImage& image, const FitPoints& points,
      const FitOptions& options)
      : space_(image, 1),
        start_(start),
        points_(points),
        options_(options),
        neighbors_(std::move(neighbors)),
        umbrella_(neighbors_, points.links),
        now_(start),
        springs_(springs_at(space_, start.points, 0)),
        shifts_(start.points.size()),
        blind_(start.points.size(), 0),
        aims_(start.points.size(), 1) {}

  void round() {
    aim();
    shifts_ = relax(umbrella_, springs_, options_.bending, std::move(shifts_));
    parallel_for(shifts_.size(),
                 [&](std::size_t p) { now_.points[p] = start_.points[p] + shifts_[p]; });
  }

  /// Points whose triangles meet, and those beside them, look for no edge any more: that of another
  /// boundary attracts them. Those around aim anew in the next round, no others.
  /// @return whether any of those that meet looked for an edge so far.
  bool blind_where_triangles_meet() {
    std::vector<double> meets(blind_.size(), 0);
    bool any_looked = false;
    for (const TrianglePair& pair : pairs_that_meet()) {
      for (const Index t : pair) {
        for (const Index p : now_.triangles[t]) {
          meets[p] = 1;
          any_looked |= blind_[p] == 0;
        }
      }
    }
    if (!any_looked) return false;
    meets = rings_around(std::move(meets), kBlindRings);
    for (std::size_t p = 0; p < blind_.size(); ++p) {
      if (meets[p] > 0) blind_[p] = 1;
    }
    meets = rings_around(std::move(meets), kAimRings);
    for (std::size_t p = 0; p < aims_.size(); ++p) aims_[p] = meets[p] > 0 ? 1 : 0;
    return true;
  }

  /// The points where they are now; where triangles would meet nearer to, or at, the start.
  TriMesh surface() const {
    std::vector<Vec3> shifts(shifts_.size());
    for (std::size_t p = 0; p < shifts.size(); ++p) {
      shifts[p] = space_.within_box(start_.points[p], shifts_[p]);
    }
    return moved_without_folds(space_, start_, std::move(shifts), Unfolded::kInFile);
  }

 private:
  static constexpr int kBlindRings = 4, kAimRings = 4;

  std::vector<double> rings_around(std::vector<double> chosen, int rings) const {
    for (int ring = 0; ring < rings; ++ring) chosen = greatest_around(neighbors_, chosen);
    return chosen;
  }

  std::vector<TrianglePair> pairs_that_meet() {
    if (intersections_) return intersections_->after_move();
    return intersections_.emplace(now_).all();
  }

  bool looks(std::size_t p) const {
    return springs_.held[p] == 0 && points_.contrast[p] != 0 && points_.on_curve[p] == 0 &&
           blind_[p] == 0;
  }

  /// Pulls each point to the edge that it sees, or else to where it began: goals are shifts.
  void aim() {
    const std::vector<Vec3> normals = smoothed_normals(now_, neighbors_, points_.on_curve);
    parallel_for(now_.points.size(), [&](std::size_t p) {
      if (aims_[p] == 0) return;
      ImageEdge edge;
      if (looks(p)) {
        edge = find_image_edge(space_, now_.points[p], normals[p],
                               {points_.contrast[p], options_.reach, options_.sheets});
      }
      const double stay = (1 - edge.weight) * options_.start;
      const Vec3 seen = now_.points[p] + (edge.distance * space_.voxel()) * normals[p];
      springs_.weight[p] = edge.weight + stay;
      springs_.goal[p] = (edge.weight / springs_.weight[p]) * (seen - start_.points[p]);
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
  std::vector<Vec3> shifts_;                        // from the start
  std::vector<char> blind_;                         // 1: looks for no edge
  std::vector<char> aims_;                          // 1: has another goal in the next round
  std::optional<SelfIntersections> intersections_;  // of now_
};

}  // namespace

TriMesh fit_surface(const TriMesh& surface, const SplineImage& image, const FitPoints& points,
                    const FitOptions& options) {
  require_sound(surface);
  const std::size_t n = surface.points.size();
  Neighbors neighbors(surface);
  if (points.contrast.size() != n || points.on_curve.size() != n ||
      points.links.size() != neighbors.points.size()) {
    throw InputError(
        "fit: expected an entry for each point of the surface and each neighbour of it");
  }
  Fit fit(surface, std::move(neighbors), image, points, options);
  for (int round = 0; round < options.rounds; ++round) fit.round();
  constexpr int kMostUnfoldings = 10;
  for (int trial = 0; trial < kMostUnfoldings && fit.blind_where_triangles_meet(); ++trial) {
    fit.round();
  }
  return fit.surface();
}

}  // namespace mesamis::detail::fit
