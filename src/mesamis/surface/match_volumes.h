// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "mesamis/surface/smooth_memberships.h"

namespace mesamis {

/// By how much a node's own material wins at least.
inline constexpr float kLeastLead = 0.02F;

/// The volume of each material's nodes: a voxel each, as far as it lies within the grid.
/// @param grid      its size, spacing and number of materials count.
/// @param material  of each node.
/// @return mm^3.
std::vector<double> part_volumes(const GridMemberships& grid, const std::vector<Index>& material);

/// Adds a constant to the memberships of each material, so that it has the volume wanted.
/// Everywhere the node's own material stays ahead by kLeastLead.
/// @param wanted  of each material, mm^3, > 0.
/// @param report  rounds, volume_error and converged are set.
///
/// O(nodes) per round.
void match_volumes(GridMemberships& memberships, const std::vector<double>& wanted,
                   const SmoothOptions& options, SmoothReport& report);

}  // namespace mesamis
