// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "mesamis/remesh/workbench.h"

namespace mesamis::detail::remesh {

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

/// Proposes the best cells without an edge of a cell, whatever they are worth; the shell is found.
/// @return false if there are none that are valid and fit the body's skin.
bool propose_without_edge(Workbench& bench, Index cell, std::array<Index, 2> edge);

/// Proposes three cells in the place of a cell and its neighbour across a face.
/// @return false if there is no neighbour of the same material.
bool propose_without_face(Workbench& bench, Index cell, int face);

}  // namespace mesamis::detail::remesh
