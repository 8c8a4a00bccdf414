// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "mesamis/remesh/workbench.h"

namespace mesamis::remeshing {

struct SwapRule {
  double quality3_max = 0.512;  ///< better cells are left alone
  double gain = 0.05;           ///< energy that a swap must save
};

/// For each bad pending cell, makes the best of the swaps around it: removing one of
/// its edges, or turning the face to a neighbour into an edge.
/// @return the number of swaps.
std::int64_t swap_bad_cells(Workbench& bench, const SwapRule& rule);

/// Makes the swap around one cell that saves most energy, if any saves more than `gain`.
bool swap_around_cell(Workbench& bench, Index cell, double gain);

}  // namespace mesamis::remeshing
