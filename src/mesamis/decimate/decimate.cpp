// SPDX-License-Identifier: Apache-2.0
#include "mesamis/decimate/decimate.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "mesamis/base/error.h"
#include "mesamis/base/parallel.h"
#include "mesamis/decimate/patchwork.h"
#include "mesamis/surface/distance.h"
#include "mesamis/surface/farthest.h"
#include "mesamis/surface/unused_points.h"

namespace mesamis {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// Triangles of a patch, about. Smaller surfaces are one patch.
constexpr double kTrianglesPerPatch = 40'000;
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

/// The side of the boxes that hold a patch each, mm. A box cuts the surface in about two sheets.
double patch_side(const TriMesh& surface, const DecimateOptions& options) {
  const auto triangles = static_cast<double>(surface.triangles.size());
  // The order of the collapses decides which triangles are left when their number is given.
  const bool is_one = triangles < 2 * kTrianglesPerPatch || options.triangles > 0;
  if (is_one) return kInfinity;
  return std::sqrt(check_surface(surface).area / triangles * kTrianglesPerPatch / 2);
}

/// A surface is decimated patch by patch; then, as a whole, where these touch.
class Decimation {
 public:
  Decimation(const TriMesh& surface, const DecimateOptions& options)
      : surface_(surface), options_(options), tree_(surface) {}

  TriMesh run() {
    Cover cover = cover_of(surface_);
    const double side = patch_side(surface_, options_);
    std::vector<char> open(surface_.points.size(), 1);  // of each point 1 if it may go
    if (!std::isinf(side)) {
      std::vector<Patch> patches = cut_into_patches(surface_.points, std::move(cover), side);
      open = held_in(patches);
      cover = decimate_patchwork(task(0, kShareOfPatches), std::move(patches), report_);
      choose_rings(cover.triangles, kRingsAtSeams, open);
    }
    std::vector<Patch> whole = cut_into_patches(surface_.points, std::move(cover), kInfinity);
    for (std::size_t p = 0; p < whole[0].points.size(); ++p) {
      whole[0].held[p] = open[whole[0].points[p]] == 0 ? 1 : 0;
    }
    const double begin = std::isinf(side) ? 0 : kShareOfPatches;
    cover = decimate_patchwork(task(begin, 1), std::move(whole), report_);
    return {surface_.points, std::move(cover.triangles)};
  }

  const PatchworkReport& report() const { return report_; }

 private:
  static constexpr double kShareOfPatches = 0.85;  // of the work
  static constexpr int kRingsAtSeams = 4;

  /// @param begin, end  shares of the work.
  DecimateTask task(double begin, double end) const {
    auto tell = [this, begin, end](double share) {
      const double done = begin + (end - begin) * std::clamp(share, 0.0, 1.0);
      if (options_.progress && !options_.progress("decimation", done)) throw Cancelled();
    };
    return {surface_, tree_, options_.tolerance / kDistanceSlack, options_.triangles, tell};
  }

  /// Of each point of the original 1 if patches hold it because they touch there.
  std::vector<char> held_in(const std::vector<Patch>& patches) const {
    std::vector<char> held(surface_.points.size(), 0);
    for (const Patch& patch : patches) {
      for (std::size_t p = 0; p < patch.points.size(); ++p) held[patch.points[p]] |= patch.held[p];
    }
    return held;
  }

  const TriMesh& surface_;
  const DecimateOptions& options_;
  TriangleTree tree_;
  PatchworkReport report_;
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
  counts.passes = decimation.report().passes;
  counts.points_held = decimation.report().points_held;
  counts.triangles_after = static_cast<std::int64_t>(result.triangles.size());
  if (report) {
    const double fine = fine_enough(surface, options.tolerance);
    counts.original_to_result = max_distance(surface, result, fine);
    counts.result_to_original = max_distance(result, surface, fine);
  }
  return result;
}

}  // namespace mesamis
