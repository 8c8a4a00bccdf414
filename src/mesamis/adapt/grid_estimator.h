// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "mesamis/adapt/estimator.h"
#include "mesamis/adapt/metric_from_estimate.h"
#include "mesamis/base/sym3.h"
#include "mesamis/fem/grid_space.h"

namespace mesamis {

/// The estimator on a Kuhn grid, and the metric it leads to. Nothing is kept per cell.
struct GridEstimate {
  std::vector<PackedSym3> node_metrics;  ///< as node_metrics(): 3/8 of the volume-weighted mean
  EstimateSums sums;                     ///< over the cells
  double predicted_cells = 0;            ///< (11)
};

/// The same numbers as estimate(), cell_metric(), predicted_cells() and node_metrics() on the
/// grid's tetrahedra, computed layer by layer; nodal metrics in single precision.
///
/// @param u, v, f  one value per node.
/// @param metric   as for cell_metric(); its cell_count is not used, the grid knows it.
/// @throws InputError  for sizes that differ.
GridEstimate estimate_on_grid(const KuhnGrid& grid, const AtParameters& parameters,
                              std::span<const double> u, std::span<const double> v,
                              std::span<const double> f, CellMetricOptions metric);

/// Averages each node's logarithm with those of its six neighbours (weight 2 to 1 each), some
/// times over. Without it a mesh refined from a coarse start can miss features one voxel thin.
void smooth_log_metrics(const KuhnGrid& grid, std::vector<PackedSym3>& logs, int sweeps);

}  // namespace mesamis
