// SPDX-License-Identifier: Apache-2.0
#include "mesamis/decimate/decimate.h"

#include <cmath>
#include <string>
#include <utility>

#include "mesamis/base/error.h"
#include "mesamis/decimate/decimation.h"
#include "mesamis/surface/distance.h"
#include "mesamis/surface/unused_points.h"

namespace mesamis::detail::decimate {
namespace {

void require_decimatable(const TriMesh& surface) {
  if (surface.triangles.empty()) throw InputError("decimate: the surface has no triangle");
  const std::string flaws = flaws_of(check_surface(surface));
  if (flaws.empty()) return;
  throw InputError("decimate: expected a closed 2-manifold surface, found " + flaws);
}

}  // namespace

TriMesh decimate(const TriMesh& surface, const DecimateOptions& options, DecimateReport* report) {
  Cover cover = decimate_to_cover(surface, options, report);
  return {std::move(cover.points), std::move(cover.triangles)};
}

Cover decimate_to_cover(const TriMesh& surface, const DecimateOptions& options,
                        DecimateReport* report) {
  require_valid(options);
  require_decimatable(surface);
  DecimateReport unused;
  DecimateReport& counts = report ? *report : unused;
  counts = {};
  counts.triangles_before = counts.triangles_after =
      static_cast<std::int64_t>(surface.triangles.size());
  if (options.tolerance == 0) return unproved(surface);
  PatchworkReport work;
  Cover cover = decimate_surface(surface, options, kTrianglesPerPatch, work);
  TriMesh result = without_unused_points({std::move(cover.points), std::move(cover.triangles)});
  counts.triangles_after = static_cast<std::int64_t>(result.triangles.size());
  counts.original_to_result = work.from_originals;
  counts.result_to_original = work.to_originals;
  if (report && std::isinf(options.tolerance)) {
    const double fine = fine_enough(surface, options.tolerance);
    counts.original_to_result = max_distance(surface, result, fine);
    counts.result_to_original = max_distance(result, surface, fine);
  }
  cover.points = std::move(result.points);
  cover.triangles = std::move(result.triangles);
  return cover;
}

}  // namespace mesamis::detail::decimate
