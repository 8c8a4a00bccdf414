// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "mesamis/base/progress.h"
#include "mesamis/mesh/metric_field.h"
#include "mesamis/mesh/tet_mesh.h"

namespace mesamis::detail::remesh {

/// Cells that remesh() makes per unit of the metric's complexity, the integral of sqrt(det M).
inline constexpr double kCellsPerComplexity = 9.3;

/// How long to remesh, and how finely.
struct RemeshOptions {
  int max_rounds = 40;         ///< split, collapse, swap, smooth rounds at most
  int polish_rounds = 3;       ///< quality-only rounds at the end
  std::int64_t max_cells = 0;  ///< coarsen the metric until at most about this many; 0: never
  /// For a mesh whose last few edges need not fit: the rounds have converged as soon as fewer than
  /// a fifth of the vertices are inserted or removed, and one polish round follows at most.
  bool draft = false;
  /// Of remesh_body(): vertices of the skin leave the border within the tolerance, so that the
  /// body's volume is kept.
  bool balanced = false;
  Index part_cells = 40000;  ///< cells per part of the parallel schedule
  Progress progress;         ///< optional
};

/// What remesh() did.
struct RemeshReport {
  int rounds = 0;
  std::int64_t splits = 0, collapses = 0, swaps = 0, moves = 0;
  double size_factor = 1;  ///< by which max_cells enlarged the metric's sizes
  bool converged = false;  ///< false: max_rounds ended the work; see draft

  double seconds = 0;  ///< wall time of the whole call
  /// Wall time of each part, by round with parts. Parts run in threads; the rest of the time passes
  /// between the rounds, mostly in one thread.
  std::vector<std::vector<double>> part_seconds;
};

/// About how many cells remesh() makes of a box: the complexity of the metric, sampled at 2^18
/// places, times kCellsPerComplexity.
/// @param metric  in 1/mm^2, defined on the whole box; called in threads.
/// @param box     mm.
///
/// O(1) look-ups. The same bits for any number of threads.
double cells_for_metric(const MetricField& metric, const Box& box);

/// Builds a mesh of the start mesh's box whose edges have length one in the metric.
///
/// It splits, collapses, swaps and smooths in rounds. Each operation replaces a cavity only if
/// every new cell is certified positive, so the mesh is valid at any time. The domain is a box: a
/// vertex on a box plane, edge or corner stays there.
///
/// @param start   a valid mesh of the box, mm: coarse_box_mesh(), or faster a mesh of an earlier
///                call with a similar metric.
/// @param metric  in 1/mm^2, defined on the whole box; called in threads.
/// @param report  optional.
/// @return a mesh for which validate() holds; about 9 cells per unit of the metric's complexity.
///         The same bits for any number of threads.
/// @throws InputError  if start is not a valid mesh of its bounding box, or the metric asks for
///                     more cells than fit and max_cells is not set.
/// @throws Cancelled   if progress returns false.
///
/// O(m) per round for m cells; memory 64 bytes per cell and vertex, twice that with several parts.
TetMesh remesh(const TetMesh& start, const MetricField& metric, const RemeshOptions& options = {},
               RemeshReport* report = nullptr);

}  // namespace mesamis::detail::remesh
