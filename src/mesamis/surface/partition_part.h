// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "mesamis/surface/partition.h"

namespace mesamis::detail::surface {

/// Where a point of a partition sits: inside of the simplex of these nodes of the whole grid,
/// increasing; after them kNoIndex. Four times the same node: in the cube above it, see
/// extract_net_on_grid().
using WholeSite = std::array<std::int64_t, 4>;

/// The slices of a grid of nodes, with the cubes above each, that a PartitionPart is made of.
struct NodeSlices {
  Index begin = 0, end = 0;
  std::size_t count() const { return static_cast<std::size_t>(end - begin); }
};

/// Some of a partition, which other parts go on from.
struct PartitionPart {
  std::vector<WholeSite> sites;  ///< of each point, increasing
  PartitionSurface surface;      ///< open where it goes on
};

/// Joins the parts of a partition, in their order: points of one site are one. O(n log n).
PartitionSurface join_parts(std::vector<PartitionPart> parts);

}  // namespace mesamis::detail::surface
