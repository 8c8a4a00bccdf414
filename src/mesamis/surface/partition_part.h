// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <span>
#include <vector>

#include "mesamis/surface/partition.h"

namespace mesamis::detail::surface {

/// Where a point of a partition sits: inside of the simplex of these nodes, increasing; after them
/// kNoIndex. Four times the same node: in the cube above it, see extract_net_on_grid().
using Simplex = std::array<Index, 4>;

/// The slices of a grid of nodes, with the cubes above each, that a PartitionPart is made of.
struct NodeSlices {
  Index begin = 0, end = 0;
};

/// Some of a partition, which other parts go on from.
struct PartitionPart {
  std::vector<Simplex> sites;  ///< of each point, by the nodes of the whole grid; increasing
  PartitionSurface surface;
};

/// Joins the parts of a partition, in their order: points of one site are one. O(n log n).
PartitionSurface join_parts(std::vector<PartitionPart> parts);

}  // namespace mesamis::detail::surface
