// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "mesamis/surface/smooth_memberships.h"

namespace mesamis {

/// By how much a node's own material wins at least.
inline constexpr float kLeastLead = 0.02F;

/// Adds a constant to the memberships of each material, so that its volume is that of its nodes: a
/// voxel each, as far as it lies within the grid. Everywhere the node's own material stays ahead by
/// kLeastLead.
/// @param report  rounds, volume_error and converged are set.
///
/// O(nodes) per round.
void match_volumes(GridMemberships& memberships, const SmoothOptions& options,
                   SmoothReport& report);

}  // namespace mesamis
