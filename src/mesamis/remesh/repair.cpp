// SPDX-License-Identifier: Apache-2.0
#include "mesamis/remesh/repair.h"

#include <limits>

#include "mesamis/remesh/collapse.h"
#include "mesamis/remesh/smooth.h"
#include "mesamis/remesh/swap.h"

namespace mesamis::detail::remesh {
namespace {

bool collapse_an_edge(Workbench& bench, Index cell, const CollapseRule& rule) {
  const Cell points = bench.mesh.cells[cell].points;
  for (const auto& [i, j] : kCellEdges) {
    if (collapse_vertex(bench, points[i], points[j], rule) ||
        collapse_vertex(bench, points[j], points[i], rule)) {
      return true;
    }
  }
  return false;
}

bool move_a_vertex(Workbench& bench, Index cell) {
  const Cell points = bench.mesh.cells[cell].points;
  bool moved = false;
  for (const Index v : points) {
    bench.mesh.vertices[v].rest = 0;
    moved |= smooth_vertex(bench, v, {});
  }
  return moved;
}

}  // namespace

Counters repair_worst_cells(Workbench& bench, const RepairRule& rule) {
  constexpr double kGain = 1e-3;
  const CollapseRule collapse{.new_length_max = rule.new_length_max,
                              .quality3_min = std::numeric_limits<double>::infinity(),
                              .quality3_loss = 1.5};
  const WorkingMesh& mesh = bench.mesh;
  Counters done;
  for (int sweep = 0; sweep < rule.sweeps; ++sweep) {
    std::int64_t repaired = 0;
    const auto cells = static_cast<Index>(mesh.cells.size());
    for (Index c = 0; c < cells; ++c) {
      if (mesh.cells[c].quality3 > rule.quality3_max) continue;
      if (!take_pending(bench.mesh, c, kToRepair)) continue;
      const bool collapsed = collapse_an_edge(bench, c, collapse);
      const bool swapped = !collapsed && swap_around_cell(bench, c, kGain);
      const bool moved = !collapsed && !swapped && move_a_vertex(bench, c);
      done += {.collapses = collapsed, .swaps = swapped, .moves = moved};
      repaired += collapsed || swapped || moved;
    }
    if (repaired == 0) break;
  }
  return done;
}

}  // namespace mesamis::detail::remesh
