// SPDX-License-Identifier: Apache-2.0
#include "mesamis/surface/grid_partition.h"

#include "mesamis/surface/grid_field.h"
#include "mesamis/surface/partition_cells.h"

namespace mesamis::detail::surface {

PartitionSurface extract_partition_on_grid(const GridMemberships& memberships,
                                           const PartitionOptions& options) {
  return extract_partition_part(memberships, {0, memberships.size[2]}, options).surface;
}

PartitionPart extract_partition_part(const GridMemberships& memberships, const NodeSlices& slices,
                                     const PartitionOptions& options) {
  require_memberships(memberships);
  require_slices(memberships, slices, 0, 1);
  const GridField field(memberships, options.close_at_box);
  const auto march = [&](std::size_t b, const auto& marcher, auto& pieces) {
    field.for_cells_above(slices.begin + static_cast<Index>(b),
                          [&](const Cell& cell) { marcher.march(cell, pieces); });
  };
  return named_wholly(memberships, extract_blocks(field, slices.count(), march));
}

}  // namespace mesamis::detail::surface
