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
  if (is_one) return std::numeric_limits<double>::infinity();
  return std::sqrt(check_surface(surface).area / triangles * kTrianglesPerPatch / 2);
}

/// A surface is decimated patch by patch; then once more with other patches, where the first ones
/// touch.
class Decimation {
 public:
  Decimation(const TriMesh& surface, const DecimateOptions& options)
      : surface_(surface), options_(options), tree_(surface), side_(patch_side(surface, options)) {}

  TriMesh run() {
    Cover cover = cover_of(surface_);
    std::vector<Patch> patches = cut_into_patches(surface_.points, std::move(cover), side_, 0);
    if (patches.size() == 1) {
      cover = decimate_patchwork(task(0, 1), std::move(patches), report_);
    } else {
      const std::vector<char> seams = seams_of(patches);
      cover = decimate_patchwork(task(0, kShareOfFirst), std::move(patches), report_);
      patches = cut_into_patches(surface_.points, std::move(cover), side_, 0.5);
      for (Patch& patch : patches) hold_what_is_no_seam(patch, seams);
      cover = decimate_patchwork(task(kShareOfFirst, 1), std::move(patches), report_);
    }
    return {surface_.points, std::move(cover.triangles)};
  }

  const PatchworkReport& report() const { return report_; }

 private:
  static constexpr double kShareOfFirst = 0.9;  // of the work

  /// @param begin, end  shares of the work.
  DecimateTask task(double begin, double end) const {
    auto tell = [this, begin, end](double share) {
      const double done = begin + (end - begin) * std::clamp(share, 0.0, 1.0);
      if (options_.progress && !options_.progress("decimation", done)) throw Cancelled();
    };
    return {surface_, tree_, options_.tolerance / kDistanceSlack, options_.triangles, tell};
  }

  /// Of each point of the original 1 if patches hold it because they touch there.
  std::vector<char> seams_of(const std::vector<Patch>& patches) const {
    std::vector<char> seams(surface_.points.size(), 0);
    for (const Patch& patch : patches) {
      for (std::size_t p = 0; p < patch.points.size(); ++p) seams[patch.points[p]] |= patch.held[p];
    }
    return seams;
  }

  /// What is away from the seams has been decimated already.
  static void hold_what_is_no_seam(Patch& patch, const std::vector<char>& seams) {
    constexpr int kRings = 4;
    std::vector<char> chosen;
    for (const Index p : patch.points) chosen.push_back(seams[p]);
    choose_rings(patch.cover.triangles, kRings, chosen);
    for (std::size_t p = 0; p < chosen.size(); ++p) {
      if (chosen[p] == 0) patch.held[p] = 1;
    }
  }

  const TriMesh& surface_;
  const DecimateOptions& options_;
  TriangleTree tree_;
  double side_;  // of a patch's box, mm
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
