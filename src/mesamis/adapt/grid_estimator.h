// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "mesamis/adapt/estimator.h"
#include "mesamis/adapt/metric_from_estimate.h"
#include "mesamis/base/sym3.h"
#include "mesamis/fem/grid_space.h"

namespace mesamis::detail::adapt {

/// Fields on a Kuhn grid, one value per node each. They refer to the caller's values.
struct GridFields {
  std::span<const float> u;  ///< denoised image, grey values
  std::span<const float> v;  ///< edge indicator: 0 at edges, 1 away from them
  std::span<const float> f;  ///< the image, grey values
};

/// The estimator on a Kuhn grid, and the metric it leads to. Nothing is kept per cell.
struct GridEstimate {
  std::vector<PackedSym3> node_metrics;  ///< as node_metrics(): 3/8 of the volume-weighted mean
  EstimateSums sums;                     ///< over the cells
  double predicted_cells = 0;            ///< (11)
};

/// The same numbers as estimate(), cell_metric(), predicted_cells() and node_metrics() on the
/// grid's tetrahedra, computed layer by layer; nodal metrics in single precision.
///
/// @param grid    n nodes, at least two along each axis.
/// @param fields  n values each: the minimisers on the grid and the image.
/// @param metric  as for cell_metric(); its cell_count is not used: the grid's own counts.
/// @throws InputError  for sizes that differ.
/// O(n), in parallel; six single precision numbers per node. The same bits for any number of
/// threads.
GridEstimate estimate_on_grid(const KuhnGrid& grid, const AtParameters& parameters,
                              const GridFields& fields, CellMetricOptions metric);

/// Smooths logarithms of metrics: each sweep replaces every node's by the mean of its own (weight
/// 2) and those of its six neighbours (weight 1 each). Without it a mesh refined from a coarse
/// start can miss features one voxel thin.
/// @param logs    one per node of the grid; changed in place.
/// @param sweeps  0 or more.
///
/// O(n) per sweep; copies of an eighth of the logarithms. The same bits for any number of threads.
void smooth_log_metrics(const KuhnGrid& grid, std::vector<PackedSym3>& logs, int sweeps);

}  // namespace mesamis::detail::adapt
