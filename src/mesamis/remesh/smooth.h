// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "mesamis/remesh/workbench.h"

namespace mesamis::detail::remesh {

struct SmoothRule {
  double quality3_max = 0.729;  ///< vertices of better cells alone stay where they are
  double energy_ratio = 0.99;   ///< a move must bring the energy below this share
  double quality3_loss = 0.3;   ///< no cell may fall below this share of the worst before
  int most_rest = 2;            ///< requests for which a vertex that failed rests
  double small_gain = 0.04;     ///< a move that gains no more does not make its neighbours move
};

/// Moves vertices of bad pending cells towards where their cells would be ideal.
/// @return the number of moves.
std::int64_t smooth_bad_cells(Workbench& bench, const SmoothRule& rule);

/// Moves one vertex if that makes its cells better. Where it failed before, and only moves have
/// changed the cells around since, the vertex rests for a request or two.
bool smooth_vertex(Workbench& bench, Index vertex, const SmoothRule& rule);

}  // namespace mesamis::detail::remesh
