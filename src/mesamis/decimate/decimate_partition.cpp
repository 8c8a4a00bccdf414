// SPDX-License-Identifier: Apache-2.0
#include "mesamis/decimate/decimate_partition.h"

#include <algorithm>
#include <utility>

#include "mesamis/decimate/decimation.h"
#include "mesamis/decimate/interfaces.h"
#include "mesamis/surface/unused_points.h"

namespace mesamis::detail::decimate {
namespace {

/// Triangles over the partition's points, where these are now, with the sides of their interfaces;
/// then only the points that are used.
PartitionSurface joined(const Interfaces& interfaces, const PartitionSurface& partition,
                        const TriMesh& decimated) {
  std::vector<std::array<Index, 2>> sides(static_cast<std::size_t>(interfaces.count));
  for (std::size_t t = 0; t < partition.sides.size(); ++t) {
    sides[interfaces.of_point[interfaces.surface.triangles[t][0]]] = partition.sides[t];
  }
  TriMesh all{partition.points, {}};
  PartitionSurface result;
  for (const Triangle& t : decimated.triangles) {
    for (const Index p : t) all.points[interfaces.origin[p]] = decimated.points[p];
    all.triangles.push_back(
        {interfaces.origin[t[0]], interfaces.origin[t[1]], interfaces.origin[t[2]]});
    result.sides.push_back(sides[interfaces.of_point[t[0]]]);
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
  const Interfaces interfaces = cut_into_interfaces(partition);
  DecimateReport unused;
  DecimateReport& counts = report ? *report : unused;
  counts = {};
  counts.triangles_before = counts.triangles_after = std::ssize(partition.triangles);
  if (options.tolerance == 0 || partition.triangles.empty()) return partition;
  PatchworkReport work;
  const TriMesh result = decimate_interfaces(interfaces, options, kTrianglesPerPatch, work);
  counts.triangles_after = std::ssize(result.triangles);
  counts.original_to_result = work.from_originals;
  counts.result_to_original = work.to_originals;
  return joined(interfaces, partition, result);
}

}  // namespace mesamis::detail::decimate
