// SPDX-License-Identifier: Apache-2.0
#include "mesamis/decimate/decimate.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "mesamis/base/error.h"
#include "mesamis/base/parallel.h"
#include "mesamis/decimate/decimate_pass.h"
#include "mesamis/surface/distance.h"
#include "mesamis/surface/farthest.h"
#include "mesamis/surface/unused_points.h"

namespace mesamis {
namespace {

/// After so many passes all points are held.
constexpr int kMostPasses = 24;
/// From this pass on, wider and wider rings are held.
constexpr int kPatience = 6;

void require_decimatable(const TriMesh& surface, const DecimateOptions& options) {
  if (!(options.tolerance >= 0)) {
    throw InputError("decimate: expected a tolerance of 0 mm or more, found " +
                     std::to_string(options.tolerance));
  }
  if (options.triangles < 0) {
    throw InputError("decimate: expected 0 or more triangles, found " +
                     std::to_string(options.triangles));
  }
  if (surface.triangles.empty()) throw InputError("decimate: the surface has no triangle");
  const std::string flaws = flaws_of(check_surface(surface));
  if (flaws.empty()) return;
  throw InputError("decimate: expected a closed 2-manifold surface, found " + flaws);
}

/// Triangles around each point.
class Stars {
 public:
  explicit Stars(const TriMesh& surface) : start_(surface.points.size() + 1, 0) {
    for (const Triangle& t : surface.triangles) {
      for (const Index p : t) ++start_[static_cast<std::size_t>(p) + 1];
    }
    for (std::size_t p = 0; p + 1 < start_.size(); ++p) start_[p + 1] += start_[p];
    triangles_.resize(start_.back());
    std::vector<std::size_t> next(start_.begin(), start_.end() - 1);
    for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
      for (const Index p : surface.triangles[t]) triangles_[next[p]++] = static_cast<Index>(t);
    }
  }
  std::span<const Index> operator[](Index point) const {
    const auto p = static_cast<std::size_t>(point);
    return std::span(triangles_).subspan(start_[p], start_[p + 1] - start_[p]);
  }

 private:
  std::vector<std::size_t> start_;
  std::vector<Index> triangles_;
};

/// Triangles of `from` that reach farther than the tolerance.
std::vector<Index> triangles_beyond(const TriMesh& from, const TriangleTree& to, double tolerance) {
  std::vector<char> beyond(from.triangles.size(), 0);
  constexpr std::size_t kTrianglesPerBlock = 256;
  parallel_blocks(beyond.size(), kTrianglesPerBlock, [&](std::size_t begin, std::size_t end) {
    std::size_t hint = 0;
    for (std::size_t t = begin; t < end; ++t) {
      const Corners corners = corners_of(from, from.triangles[t]);
      beyond[t] = farthest_distance(corners, to, {tolerance, tolerance}, hint) > tolerance;
    }
  });
  std::vector<Index> found;
  for (std::size_t t = 0; t < beyond.size(); ++t) {
    if (beyond[t]) found.push_back(static_cast<Index>(t));
  }
  return found;
}

/// Repeats passes from the start, each with more points held, until no triangle is too far.
class Decimation {
 public:
  Decimation(const TriMesh& surface, const DecimateOptions& options)
      : surface_(surface),
        options_(options),
        tolerance_(options.tolerance / kDistanceSlack),
        stars_(surface),
        tree_(surface),
        held_(surface.points.size(), 0) {}

  TriMesh run() {
    for (pass_ = 1; pass_ <= kMostPasses; ++pass_) {
      result_ = {surface_.points, decimate_pass(task(), held_)};
      if (std::isinf(tolerance_) || !hold_what_is_too_far()) return std::move(result_);
    }
    pass_ = kMostPasses;
    return surface_;
  }

  int passes() const { return pass_; }
  std::int64_t points_held() const { return std::count(held_.begin(), held_.end(), 1); }

 private:
  DecimateTask task() {
    auto tell = [this](double share) {
      const double done = (pass_ - 1 + std::clamp(share, 0.0, 1.0)) / (pass_ + 1);
      if (options_.progress && !options_.progress("decimation", done)) throw Cancelled();
    };
    return {surface_, tree_, tolerance_, options_.triangles, tell};
  }

  /// A triangle whose corners are all held is never removed; a point whose triangles are all held
  /// gets no new triangle.
  /// @return whether any triangle was too far.
  bool hold_what_is_too_far() {
    const TriangleTree result_tree(result_);
    const auto lost = triangles_beyond(surface_, result_tree, tolerance_);
    const auto strayed = triangles_beyond(result_, tree_, tolerance_);
    std::vector<Index> points;
    for (const Index t : lost) add_corners(surface_.triangles[t], points);
    for (const Index t : strayed) add_corners(result_.triangles[t], points);
    for (int ring = 0; ring < 1 + std::max(0, pass_ - kPatience); ++ring) widen(points);
    for (const Index p : points) held_[p] = 1;
    return !points.empty();
  }

  static void add_corners(const Triangle& t, std::vector<Index>& points) {
    points.insert(points.end(), t.begin(), t.end());
  }

  /// Adds the neighbours.
  void widen(std::vector<Index>& points) const {
    const std::size_t count = points.size();
    for (std::size_t i = 0; i < count; ++i) {
      for (const Index t : stars_[points[i]]) add_corners(surface_.triangles[t], points);
    }
    std::sort(points.begin(), points.end());
    points.erase(std::unique(points.begin(), points.end()), points.end());
  }

  const TriMesh& surface_;
  const DecimateOptions& options_;
  double tolerance_;  // a little less, so that the reported bound is within the tolerance
  Stars stars_;
  TriangleTree tree_;
  std::vector<char> held_;
  TriMesh result_;
  int pass_ = 0;
};

}  // namespace

TriMesh decimate(const TriMesh& surface, const DecimateOptions& options, DecimateReport* report) {
  require_decimatable(surface, options);
  DecimateReport unused;
  DecimateReport& counts = report ? *report : unused;
  counts = {};
  counts.triangles_before = counts.triangles_after =
      static_cast<std::int64_t>(surface.triangles.size());
  if (options.tolerance == 0) return surface;
  Decimation decimation(surface, options);
  const TriMesh result = without_unused_points(decimation.run());
  counts.passes = decimation.passes();
  counts.points_held = decimation.points_held();
  counts.triangles_after = static_cast<std::int64_t>(result.triangles.size());
  if (report) {
    const double fine = fine_enough(surface, options.tolerance);
    counts.original_to_result = max_distance(surface, result, fine);
    counts.result_to_original = max_distance(result, surface, fine);
  }
  return result;
}

}  // namespace mesamis
