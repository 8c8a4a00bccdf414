// SPDX-License-Identifier: Apache-2.0
#include "mesamis/decimate/decimation.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "mesamis/base/error.h"
#include "mesamis/surface/farthest.h"

namespace mesamis {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// The side of the boxes that hold a patch each, mm. A box cuts the surface in about two sheets.
double patch_side(const TriMesh& surface, const DecimateOptions& options, double per_patch) {
  const auto triangles = static_cast<double>(surface.triangles.size());
  if (triangles < 2 * per_patch || options.triangles > 0) return kInfinity;
  const double side = std::sqrt(check_surface(surface).area / triangles * per_patch / 2);
  return side > 0 ? side : kInfinity;
}

class Decimation {
 public:
  Decimation(const TriMesh& surface, const DecimateOptions& options, PatchworkReport& report)
      : surface_(surface), options_(options), tree_(surface), report_(report) {}

  /// @param side  of the patches' boxes, mm; infinity: one patch.
  TriMesh run(double side) {
    Cover cover = cover_of(surface_);
    std::vector<char> open(surface_.points.size(), 1);  // of each point 1 if it may go
    if (!std::isinf(side)) {
      std::vector<Patch> patches = cut_into_patches(surface_.points, std::move(cover), side);
      open = held_in(patches);
      cover =
          decimate_patchwork(task(0, kShareOfPatches, kDistanceSlack), std::move(patches), report_);
      choose_rings(cover.triangles, kRingsAtSeams, open);
    }
    std::vector<Patch> whole = cut_into_patches(surface_.points, std::move(cover), kInfinity);
    for (std::size_t p = 0; p < whole[0].points.size(); ++p) {
      whole[0].held[p] = open[whole[0].points[p]] == 0 ? 1 : 0;
    }
    const double begin = std::isinf(side) ? 0 : kShareOfPatches;
    cover = decimate_patchwork(task(begin, 1, 1), std::move(whole), report_);
    for (const double drift : cover.drift) report_.drift = std::max(report_.drift, drift);
    return {surface_.points, std::move(cover.triangles)};
  }

 private:
  static constexpr double kShareOfPatches = 0.85;  // of the work
  static constexpr int kRingsAtSeams = 4;

  /// @param begin, end  shares of the work.
  /// @param strictness  what one search finds near by so much, any other does.
  DecimateTask task(double begin, double end, double strictness) {
    auto tell = [this, begin, end](double share) {
      // Passes that are repeated tell less than before.
      told_ = std::max(told_, begin + (end - begin) * std::clamp(share, 0.0, 1.0));
      if (options_.progress && !options_.progress("decimation", told_)) throw Cancelled();
    };
    const double tolerance = options_.tolerance / (kDistanceSlack * strictness);
    return {surface_, tree_, tolerance, options_.triangles, tell, options_.quick};
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
  PatchworkReport& report_;
  double told_ = 0;  // share of the work
};

}  // namespace

TriMesh decimate_surface(const TriMesh& surface, const DecimateOptions& options,
                         double triangles_per_patch, PatchworkReport& report) {
  return Decimation(surface, options, report)
      .run(patch_side(surface, options, triangles_per_patch));
}

}  // namespace mesamis
