// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "mesamis/remesh/counters.h"
#include "mesamis/remesh/shape_score.h"

namespace mesamis::detail::remesh {

/// Tries edge and face removals, collapses and moves on the cells whose shape is against the rule,
/// worst first; an operation is kept if the worst shape among its cells becomes better.
///
/// O(m) for m cells to find the bad ones, at each sweep, and a few hundred trials for each of them.
Counters repair_shapes(Workbench& bench, const ShapeRule& rule);

}  // namespace mesamis::detail::remesh
