// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "mesamis/base/progress.h"
#include "mesamis/mesh/metric_field.h"
#include "mesamis/mesh/tet_mesh.h"

namespace mesamis {

struct RemeshOptions {
  int max_rounds = 40;         ///< split, collapse, swap, smooth rounds at most
  int polish_rounds = 3;       ///< quality-only rounds at the end
  std::int64_t max_cells = 0;  ///< coarsen the metric until at most about this many; 0: as it is
  /// A mesh that is only to lead to the next one: the work has converged as soon as less than a
  /// fifth of the vertices come or go, and one round of polish follows at most.
  bool draft = false;
  Index part_cells = 40000;  ///< cells per part of the parallel schedule
  Progress progress;         ///< optional
};

struct RemeshReport {
  int rounds = 0;
  std::int64_t splits = 0, collapses = 0, swaps = 0, moves = 0;
  double size_factor = 1;  ///< by how much max_cells made the metric's sizes larger
  bool converged = false;  ///< false: max_rounds ended the work; see draft

  // What threads share: the rest of the time is spent between the rounds, mostly by one thread.
  double seconds = 0;                             ///< of the whole call
  std::vector<std::vector<double>> part_seconds;  ///< of each part, by round worked on in parts
};

/// Builds a mesh of the start mesh's box whose edges have length one in the metric.
///
/// Split, collapse, swap and smooth in rounds; each operation replaces a cavity only if every
/// new cell is certified positive, so the mesh is valid at any time. The domain is a box: a
/// vertex on a box plane, edge or corner stays there.
///
/// @param start   a valid mesh of the box; a coarse box_mesh will do, the last mesh is faster.
/// @param metric  defined on the whole box; must outlive the call.
/// @param report  optional.
/// @return a mesh for which validate() holds; about 9 cells per unit of the metric's complexity.
///         The same bits for any number of threads.
/// @throws InputError  if start is not a valid mesh of its bounding box, or the metric asks for
///                     more cells than fit and max_cells is not set.
/// @throws Cancelled   if progress says stop.
TetMesh remesh(const TetMesh& start, const MetricField& metric, const RemeshOptions& options = {},
               RemeshReport* report = nullptr);

}  // namespace mesamis
