// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "mesamis/remesh/workbench.h"

namespace mesamis::detail::remesh {

struct CollapseRule {
  double length_min = 0.70710678118654752;  ///< shorter edges are collapsed
  double new_length_max = 1.6;              ///< no new edge is longer
  /// Above 0: the bound is instead this over the edge's length, but no less than the goal's upper
  /// bound.
  double balance = 0;
  double quality3_min = 0.008;  ///< new cells are at least this good,
  double quality3_loss = 0.3;   ///< or lose no more than this factor
  double quality3_floor = 0;    ///< none is worse, whatever else holds, than this and all before
};

/// Collapses short edges of pending cells, shortest first, onto one of their ends, and moves that
/// end at once to where its cells are better, as smooth_vertex().
/// @return the number of collapses.
std::int64_t collapse_short_edges(Workbench& bench, const CollapseRule& rule);

/// What the cells of a collapse must keep.
struct CollapseLimits {
  double quality3_min;    ///< no cell is worse
  double new_length_max;  ///< no new edge is longer
};

/// Proposes the cells around a vertex with its neighbour in its place, if they are valid, within
/// the limits, and fit the body's skin.
/// @param ball  the cells around the vertex.
/// @param move  the vertex, and the neighbour.
bool propose_collapse(Workbench& bench, std::span<const Index> ball, std::array<Index, 2> move,
                      const CollapseLimits& limits);

/// Moves a vertex onto a neighbour, which takes its place, if the rule allows.
bool collapse_vertex(Workbench& bench, Index vertex, Index onto, const CollapseRule& rule);

}  // namespace mesamis::detail::remesh
