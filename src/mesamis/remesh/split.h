// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "mesamis/remesh/workbench.h"

namespace mesamis::remeshing {

struct SplitRule {
  double length_max = 1.4142135623730951;  ///< longer edges are split
  double new_length_min = 0.6;             ///< the new vertex keeps this distance in the metric
  double urgent_length = 2;      ///< longer edges are split whatever comes out, if it is valid
  double quality3_min = 0.008;   ///< new cells are at least this good,
  double quality3_loss = 0.125;  ///< or lose no more than this factor
  std::int64_t most_cells = kMostCells;  ///< no split once there are as many
};

/// Splits long edges of cells not yet looked at, longest first, at their middle in the metric.
/// @return the number of splits.
std::int64_t split_long_edges(Workbench& bench, const SplitRule& rule);

/// Splits one edge of a cell if the rule allows; an urgent split needs to be valid only.
bool split_edge(Workbench& bench, Index cell, std::array<Index, 2> edge, const SplitRule& rule,
                bool urgent);

}  // namespace mesamis::remeshing
