// SPDX-License-Identifier: Apache-2.0
#include "mesamis/surface/smooth_memberships.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "mesamis/base/error.h"
#include "mesamis/surface/label_parts.h"
#include "mesamis/surface/lift_memberships.h"
#include "mesamis/surface/match_volumes.h"
#include "mesamis/surface/part_filter.h"
#include "mesamis/surface/yield_nodes.h"

namespace mesamis::detail::surface {
namespace {

void require_labels(const LabelGrid& grid, const SmoothOptions& options) {
  const auto [x, y, z] = grid.size;
  const bool fits = std::min({x, y, z}) >= 2 &&
                    std::int64_t{x} * y <= std::numeric_limits<Index>::max() / z &&
                    std::int64_t{x} * y * z == std::ssize(grid.labels);
  if (!fits) throw InputError("labels: expected one per node of a grid of 2 or more a side");
  for (const double spacing : {grid.spacing.x, grid.spacing.y, grid.spacing.z}) {
    if (!(spacing > 0 && std::isfinite(spacing))) {
      throw InputError("labels: expected a finite spacing above 0");
    }
  }
  if (!(options.sigma_voxel >= 0.5 && options.sigma_voxel <= 4)) {
    throw InputError("labels: expected a Gaussian of 0.5 to 4 voxels, found " +
                     std::to_string(options.sigma_voxel));
  }
  if (!(options.volume_accuracy > 0) || options.most_rounds < 0) {
    throw InputError("labels: expected a volume accuracy above 0 and 0 or more rounds");
  }
}

}  // namespace

Index smoothing_reach(const SmoothOptions& options) {
  return 2 * filter_radius(options.sigma_voxel) + kLiftReach;
}

GridMemberships smooth_memberships(const LabelGrid& grid, const SmoothOptions& options,
                                   SmoothReport* report) {
  require_labels(grid, options);
  LabelParts parts = find_label_parts(grid);
  GridMemberships memberships{.size = grid.size,
                              .spacing = grid.spacing,
                              .material = parts.of_node,
                              .label = std::move(parts.label),
                              .first = {},
                              .listed = {},
                              .value = {}};
  filter_parts(parts.of_node, options.sigma_voxel, memberships);
  if (yield_nodes(memberships) > 0) {
    filter_parts(parts.of_node, options.sigma_voxel, memberships);
  }
  lift_memberships(memberships);
  const SmoothReport reached = match_volumes(
      memberships, volumes_of(voxel_eighths(memberships, parts.of_node), grid.spacing), options);
  if (report != nullptr) {
    *report = reached;
    report->parts = static_cast<Index>(memberships.label.size());
  }
  return memberships;
}

}  // namespace mesamis::detail::surface
