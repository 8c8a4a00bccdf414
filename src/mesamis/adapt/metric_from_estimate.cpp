// SPDX-License-Identifier: Apache-2.0
#include "mesamis/adapt/metric_from_estimate.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "mesamis/adapt/cell_shape.h"
#include "mesamis/base/error.h"
#include "mesamis/base/parallel.h"

namespace mesamis::detail::adapt {
namespace {

void require_one_per_cell(const TetMesh& mesh, std::size_t metrics) {
  if (metrics != mesh.cells.size()) {
    throw InputError("metric: expected one per cell (" + std::to_string(mesh.cells.size()) +
                     "), found " + std::to_string(metrics));
  }
}

}  // namespace

Sym3 cell_metric(const Sym3& gamma, const CellMetricOptions& options) {
  const double size = trace(gamma);
  // Denormal numbers have no finite reciprocal; what is that small is flat.
  if (!(size >= std::numeric_limits<double>::min())) return {};
  // Scaled to trace one: the determinant of tiny or huge entries would leave the range.
  const double share = 1 / (options.max_stretch * options.max_stretch);
  const Sym3 unit = (1 / size) * gamma + share * kIdentity3;
  const double equidistribution = std::sqrt(std::sqrt(3.0) * kReferenceVolume *
                                            static_cast<double>(options.cell_count) / options.tau);
  const double det = std::max(determinant(unit), 0.1 * share * share);
  return equidistribution * std::sqrt(std::sqrt(size / det)) * unit;
}

double predicted_cells(const TetMesh& mesh, std::span<const Sym3> cell_metrics) {
  require_one_per_cell(mesh, cell_metrics.size());
  return parallel_sum(mesh.cells.size(), [&](std::size_t begin, std::size_t end) {
    double sum = 0;
    for (std::size_t c = begin; c < end; ++c) {
      const double det = std::max(determinant(cell_metrics[c]), 0.0);
      sum += cell_volume(mesh, static_cast<Index>(c)) * std::sqrt(det) / kReferenceVolume;
    }
    return sum;
  });
}

std::vector<Sym3> node_metrics(const TetMesh& mesh, std::span<const Sym3> cell_metrics) {
  require_one_per_cell(mesh, cell_metrics.size());
  std::vector<Sym3> sums(mesh.points.size());
  std::vector<double> volumes(mesh.points.size(), 0);
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    const double volume = cell_volume(mesh, static_cast<Index>(c));
    for (const Index n : mesh.cells[c]) {
      sums[n] += volume * cell_metrics[c];
      volumes[n] += volume;
    }
  }
  for (std::size_t n = 0; n < sums.size(); ++n) sums[n] = (3.0 / 8 / volumes[n]) * sums[n];
  return sums;
}

}  // namespace mesamis::detail::adapt
