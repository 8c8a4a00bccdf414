// SPDX-License-Identifier: Apache-2.0
#include "mesamis/decimate/decimate_partition.h"

#include <algorithm>
#include <utility>

#include "mesamis/decimate/decimation.h"
#include "mesamis/decimate/sheets.h"
#include "mesamis/surface/distance.h"
#include "mesamis/surface/unused_points.h"

namespace mesamis {
namespace {

void measure(const Sheets& sheets, const TriMesh& result, double tolerance,
             DecimateReport& report) {
  const auto before = split_sheets(sheets, sheets.surface.triangles);
  const auto after = split_sheets(sheets, result.triangles);
  for (std::size_t s = 0; s < before.size(); ++s) {
    const double fine = fine_enough(before[s], tolerance);
    report.original_to_result =
        std::max(report.original_to_result, max_distance(before[s], after[s], fine));
    report.result_to_original =
        std::max(report.result_to_original, max_distance(after[s], before[s], fine));
  }
}

/// Triangles over the partition's points, with the sides of their sheets; then only the points that
/// are used.
PartitionSurface joined(const Sheets& sheets, const PartitionSurface& partition,
                        const std::vector<Triangle>& triangles) {
  std::vector<std::array<Index, 2>> sides(static_cast<std::size_t>(sheets.count));
  for (std::size_t t = 0; t < partition.sides.size(); ++t) {
    sides[sheets.of_point[sheets.surface.triangles[t][0]]] = partition.sides[t];
  }
  TriMesh all{partition.points, {}};
  PartitionSurface result;
  for (const Triangle& t : triangles) {
    all.triangles.push_back({sheets.origin[t[0]], sheets.origin[t[1]], sheets.origin[t[2]]});
    result.sides.push_back(sides[sheets.of_point[t[0]]]);
  }
  all = without_unused_points(all);
  result.points = std::move(all.points);
  result.triangles = std::move(all.triangles);
  return result;
}

}  // namespace

PartitionSurface decimate_partition(const PartitionSurface& partition,
                                    const DecimateOptions& options, DecimateReport* report) {
  require_valid(options);
  const Sheets sheets = cut_into_sheets(partition);
  DecimateReport unused;
  DecimateReport& counts = report ? *report : unused;
  counts = {};
  counts.triangles_before = counts.triangles_after = std::ssize(partition.triangles);
  if (options.tolerance == 0 || partition.triangles.empty()) return partition;
  PatchworkReport work;
  const TriMesh result = decimate_sheets(sheets, options, kTrianglesPerPatch, work);
  counts.passes = work.passes;
  counts.points_held = work.points_held;
  counts.triangles_after = std::ssize(result.triangles);
  if (options.quick) {
    counts.original_to_result = counts.result_to_original = work.drift;
  } else if (report) {
    measure(sheets, result, options.tolerance, counts);
  }
  return joined(sheets, partition, result.triangles);
}

}  // namespace mesamis
