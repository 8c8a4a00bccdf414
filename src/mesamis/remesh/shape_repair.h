// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "mesamis/remesh/counters.h"
#include "mesamis/remesh/workbench.h"

namespace mesamis::remeshing {

/// What shape a cell must have in space, not in the metric: solvers ask for it.
struct ShapeRule {
  double least_angle = 16;        ///< dihedral, degrees
  double greatest_angle = 158;    ///< dihedral, degrees
  double scaled_jacobian = 0.22;  ///< see ElementShape
  double new_length_max = 3;      ///< a collapse makes no longer edge, in the metric
  int sweeps = 10;
};

/// Tries edge and face removals, collapses and moves on the cells whose shape is against the rule,
/// worst first; an operation is kept if the worst shape among its cells becomes better.
///
/// O(m) for m cells to find the bad ones, at each sweep, and a few hundred trials for each of them.
Counters repair_shapes(Workbench& bench, const ShapeRule& rule);

}  // namespace mesamis::remeshing
