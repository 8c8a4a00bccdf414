// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "mesamis/remesh/workbench.h"

namespace mesamis::detail::remesh {

struct SplitRule {
  double length_max = 1.4142135623730951;  ///< longer edges are split
  double new_length_min = 0.6;             ///< the new vertex keeps this distance in the metric
  /// Above 0: the distance is instead this over the edge's length, but no more than the goal's
  /// lower bound: what is made is hardly farther from 1 than what goes.
  double balance = 0;
  double urgent_length = 2;      ///< longer edges are split whatever comes out, if it is valid
  double quality3_min = 0.008;   ///< new cells are at least this good,
  double quality3_loss = 0.125;  ///< or lose no more than this factor
  double quality3_floor = 0;     ///< none is worse, whatever else holds, than this and all before
  std::int64_t most_cells = kMostCells;  ///< no split once there are as many
};

/// Splits long edges of pending cells, longest first, at their middle in the metric.
/// @return the number of splits.
std::int64_t split_long_edges(Workbench& bench, const SplitRule& rule);

/// The edge (a, b) of a cell, to be split.
struct SplitEdge {
  Index cell, a, b;
  bool urgent = false;  ///< the new cells need to be valid, and not below the floor, only
};

/// Splits one edge at its middle in the metric if the rule allows.
/// @return whether it was split.
bool split_edge(Workbench& bench, const SplitEdge& edge, const SplitRule& rule);

/// Splits an edge at a share of the way, kept off the ends.
/// @param on_skin  whether the new vertex belongs to the skin of a body.
/// @return the new vertex; kNoIndex if a new cell would not be positive.
Index split_edge_at(Workbench& bench, const SplitEdge& edge, double share, bool on_skin);

}  // namespace mesamis::detail::remesh
