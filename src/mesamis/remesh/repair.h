// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "mesamis/remesh/counters.h"
#include "mesamis/remesh/workbench.h"

namespace mesamis::detail::remesh {

struct RepairRule {
  double quality3_max = 0.25;   ///< only worse cells are taken up
  double new_length_max = 2.5;  ///< a collapse may spoil lengths this far
  int sweeps = 4;
};

/// Tries everything on the worst cells, in this order: collapses that make the worst of their
/// cells clearly better even at the price of lengths, swaps, moves.
Counters repair_worst_cells(Workbench& bench, const RepairRule& rule);

}  // namespace mesamis::detail::remesh
