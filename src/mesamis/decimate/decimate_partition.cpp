// SPDX-License-Identifier: Apache-2.0
#include "mesamis/decimate/decimate_partition.h"

#include <algorithm>
#include <utility>

#include "mesamis/base/parallel.h"
#include "mesamis/decimate/decimation.h"
#include "mesamis/decimate/sheets.h"
#include "mesamis/surface/distance.h"

namespace mesamis {
namespace {

/// Triangles of a patch, about. Surfaces of less than two are one patch.
constexpr double kTrianglesPerPatch = 40'000;

/// The triangles of each sheet.
std::vector<TriMesh> split_sheets(const Sheets& sheets, const std::vector<Triangle>& triangles) {
  std::vector<TriMesh> split(static_cast<std::size_t>(sheets.count));
  std::vector<Index> place(sheets.origin.size());  // in its sheet
  for (std::size_t p = 0; p < place.size(); ++p) {
    std::vector<Vec3>& points = split[sheets.of_point[p]].points;
    place[p] = static_cast<Index>(points.size());
    points.push_back(sheets.surface.points[p]);
  }
  for (const Triangle& t : triangles) {
    split[sheets.of_point[t[0]]].triangles.push_back({place[t[0]], place[t[1]], place[t[2]]});
  }
  return split;
}

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
  std::vector<Index> place(partition.points.size(), kNoIndex);
  for (const Triangle& t : triangles) {
    for (const Index p : t) place[sheets.origin[p]] = 0;
  }
  PartitionSurface result;
  for (std::size_t p = 0; p < place.size(); ++p) {
    if (place[p] == kNoIndex) continue;
    place[p] = static_cast<Index>(result.points.size());
    result.points.push_back(partition.points[p]);
  }
  for (const Triangle& t : triangles) {
    const auto at = [&](Index p) { return place[sheets.origin[p]]; };
    result.triangles.push_back({at(t[0]), at(t[1]), at(t[2])});
    result.sides.push_back(sides[sheets.of_point[t[0]]]);
  }
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
