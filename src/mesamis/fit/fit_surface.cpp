// SPDX-License-Identifier: Apache-2.0
#include "mesamis/fit/fit_surface.h"

#include <algorithm>
#include <utility>

#include "mesamis/base/error.h"
#include "mesamis/base/parallel.h"
#include "mesamis/fit/bending.h"
#include "mesamis/fit/image_edge.h"
#include "mesamis/fit/surface_moves.h"
#include "mesamis/surface/self_intersections.h"

namespace mesamis::detail::fit {
namespace {

/// Of the rounds, how many of the last ones tell what smoothness has lost.
constexpr int kRegained = 2;

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
        lost_(start.points.size()),
        blind_(start.points.size(), 0) {}

  void round() {
    aim();
    now_.points = relax(umbrella_, springs_, options_.bending, std::move(now_.points));
  }

  /// What the last round has lost, the goals of the next ones gain.
  void regain() {
    parallel_for(lost_.size(), [&](std::size_t p) {
      if (springs_.held[p] == 0) lost_[p] = springs_.goal[p] - now_.points[p];
    });
  }

  /// Points whose triangles meet, and those beside them, look for no edge any more: that of another
  /// boundary attracts them. @return whether any of those that meet looked for one so far.
  bool blind_where_triangles_meet() {
    std::vector<double> meets(blind_.size(), 0);
    bool any_looked = false;
    for (const TrianglePair& pair : find_self_intersections(now_)) {
      for (const Index t : pair) {
        for (const Index p : now_.triangles[t]) {
          meets[p] = 1;
          any_looked |= blind_[p] == 0;
        }
      }
    }
    if (!any_looked) return false;
    for (int ring = 0; ring < kBlindRings; ++ring) meets = greatest_around(neighbors_, meets);
    for (std::size_t p = 0; p < blind_.size(); ++p) {
      if (meets[p] == 0) continue;
      blind_[p] = 1;
      lost_[p] = {};
    }
    return true;
  }

  /// The points where they are now; where triangles would meet nearer to, or at, where smoothness
  /// alone takes them from the start.
  TriMesh surface() {
    const std::vector<Vec3> fitted = now_.points;
    std::ranges::fill(blind_, char{1});
    std::ranges::fill(lost_, Vec3{});
    now_.points = start_.points;
    round();
    const TriMesh smooth = moved_to(start_, now_.points);
    return moved_to(smooth, fitted);
  }

 private:
  static constexpr int kBlindRings = 4;

  TriMesh moved_to(const TriMesh& from, const std::vector<Vec3>& goals) const {
    std::vector<Vec3> shifts(goals.size());
    for (std::size_t p = 0; p < shifts.size(); ++p) {
      shifts[p] = space_.within_box(from.points[p], goals[p] - from.points[p]);
    }
    return moved_without_folds(space_, from, std::move(shifts));
  }

  bool looks(std::size_t p) const {
    return springs_.held[p] == 0 && points_.contrast[p] != 0 && points_.on_curve[p] == 0 &&
           blind_[p] == 0;
  }

  /// Pulls each point to the edge that it sees, or else to where it began.
  void aim() {
    const std::vector<Vec3> normals = smoothed_normals(now_, neighbors_, points_.on_curve);
    parallel_for(now_.points.size(), [&](std::size_t p) {
      ImageEdge edge;
      if (looks(p)) {
        edge = find_image_edge(space_, now_.points[p], normals[p], points_.contrast[p],
                               options_.reach);
      }
      const double stay = (1 - edge.weight) * options_.start;
      const Vec3 seen = now_.points[p] + (edge.distance * space_.voxel()) * normals[p];
      springs_.weight[p] = edge.weight + stay;
      springs_.goal[p] = lost_[p] + (1 / springs_.weight[p]) *
                                        (edge.weight * seen + stay * start_.points[p]);
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
  std::vector<Vec3> lost_;   // by smoothness, so far
  std::vector<char> blind_;  // 1: looks for no edge
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
  for (int round = 0; round < options.rounds; ++round) {
    fit.round();
    if (round + kRegained >= options.rounds) fit.regain();
  }
  constexpr int kMostUnfoldings = 10;
  for (int trial = 0; trial < kMostUnfoldings && fit.blind_where_triangles_meet(); ++trial) {
    fit.round();
  }
  return fit.surface();
}

}  // namespace mesamis::detail::fit
