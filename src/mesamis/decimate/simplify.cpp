// SPDX-License-Identifier: Apache-2.0
#include "mesamis/decimate/simplify.h"

#include <cmath>
#include <utility>

#include "mesamis/decimate/decimate_partition.h"
#include "mesamis/decimate/refit.h"

namespace mesamis::detail::decimate {
namespace {

/// Of the tolerance, for decimation.
constexpr double kShare = 0.6;

bool leaves_room(const DecimateOptions& options) {
  return std::isfinite(options.tolerance) && options.tolerance > 0;
}

DecimateOptions within_share(DecimateOptions options) {
  options.tolerance *= kShare;
  return options;
}

}  // namespace

TriMesh simplify(const TriMesh& surface, const DecimateOptions& options, DecimateReport* report) {
  if (!leaves_room(options)) return decimate(surface, options, report);
  Cover few = decimate_to_cover(surface, within_share(options), report);
  return refit(std::move(few), surface, options.tolerance, report);
}

PartitionSurface simplify_partition(const PartitionSurface& partition,
                                    const DecimateOptions& options, DecimateReport* report) {
  if (!leaves_room(options)) return decimate_partition(partition, options, report);
  PartitionSurface few = decimate_partition(partition, within_share(options), report);
  if (few.triangles.size() == partition.triangles.size()) return few;
  if (report) report->original_to_result = report->result_to_original = options.tolerance;
  return refit_partition(std::move(few), partition, options.tolerance);
}

}  // namespace mesamis::detail::decimate
