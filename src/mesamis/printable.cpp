// SPDX-License-Identifier: Apache-2.0
#include "mesamis/printable.h"

#include <algorithm>
#include <limits>

#include "mesamis/surface/decimate.h"
#include "mesamis/surface/distance.h"
#include "mesamis/surface/round_to_single.h"
#include "mesamis/surface/select_parts.h"

namespace mesamis {
namespace {

TriMesh keep_parts_wanted(const TriMesh& surface, const Settings& settings,
                          PrintableReport& report) {
  const PartSelection wanted{settings.min_volume.value_or(0), settings.keep_largest,
                             settings.fill_cavities};
  return select_parts(surface, wanted, &report.parts.emplace());
}

/// First rounded, then decimated: what is left is where it was, so that what decimation promises
/// is true of every file.
TriMesh decimated(const TriMesh& surface, const Settings& settings, double tolerance,
                  const Progress& progress) {
  RoundReport rounding;
  const TriMesh rounded = round_to_single(surface, &rounding);
  DecimateOptions options;
  options.tolerance = std::max(0.0, tolerance - rounding.shift);
  options.triangles = settings.triangles.value_or(0);
  options.progress = progress;
  return decimate(rounded, options);
}

}  // namespace

TriMesh make_printable(const TriMesh& extracted, const Settings& settings, const Progress& progress,
                       PrintableReport& report) {
  report = {};
  report.triangles_extracted = static_cast<std::int64_t>(extracted.triangles.size());
  if (!flaws_of(check_surface(extracted)).empty()) return extracted;  // for the caller to find
  TriMesh surface = keep_parts_wanted(extracted, settings, report);
  report.triangles_extracted = static_cast<std::int64_t>(surface.triangles.size());
  const double otherwise = settings.triangles ? std::numeric_limits<double>::infinity() : 0;
  const double tolerance = settings.tolerance.value_or(otherwise);
  if (surface.triangles.empty() || tolerance == 0) return surface;
  TriMesh result = decimated(surface, settings, tolerance, progress);
  const double fine = fine_enough(surface, tolerance);
  report.extracted_to_result = max_distance(surface, result, fine);
  report.result_to_extracted = max_distance(result, surface, fine);
  return result;
}

}  // namespace mesamis
