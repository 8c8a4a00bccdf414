// SPDX-License-Identifier: Apache-2.0
#include "mesamis/mesh/gradation.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <vector>

#include "mesamis/base/error.h"
#include "mesamis/base/parallel.h"
#include "mesamis/base/sym3.h"
#include "mesamis/mesh/metric.h"

namespace mesamis::detail::mesh {
namespace {

Sym3 grown(const Sym3& m, const Vec3& e, double log_gradation) {
  const double factor = 1 + std::sqrt(quadratic_form(m, e)) * log_gradation;
  return (1 / (factor * factor)) * m;
}

/// Is a - b positive definite? By the pivots of its Cholesky factor.
bool exceeds(const Sym3& a, const Sym3& b) {
  const Sym3 d = a - b;
  if (!(d.xx > 0)) return false;
  const double yy = d.yy - d.xy * d.xy / d.xx;
  if (!(yy > 0)) return false;
  const double yz = d.yz - d.xy * d.xz / d.xx;
  return d.zz - d.xz * d.xz / d.xx - yz * yz / yy > 0;
}

/// A mesh with the metrics of its nodes.
struct NodeMetrics {
  const TetMesh& mesh;
  const PointCells& around;
  std::span<const Sym3> metrics;
};

/// The metric of node n, bounded by those of the other nodes of the cells around it.
Sym3 limited(const NodeMetrics& field, Index n, double log_gradation) {
  const auto& [mesh, around, metrics] = field;
  constexpr double kSlack = 1.002;  // of a squared size: less is not worth a change
  constexpr double kLeastGrowth = 1.001;
  Sym3 m = metrics[n];
  for (const Index cell : around.of(n)) {
    for (const Index other : mesh.cells[cell]) {
      if (other == n) continue;
      const Sym3 bound = grown(metrics[other], mesh.points[n] - mesh.points[other], log_gradation);
      if (exceeds(kSlack * m, bound)) continue;
      const Sym3 finer = intersect(m, bound);
      // Round-off of flat metrics does not count as a change.
      if (determinant(finer) > kLeastGrowth * determinant(m)) m = finer;
    }
  }
  return m;
}

}  // namespace

std::int64_t limit_gradation(const TetMesh& mesh, std::span<Sym3> node_metrics, double gradation) {
  const std::size_t n = mesh.points.size();
  require_one_per_node("gradation", mesh, node_metrics);
  if (!(gradation > 1)) {
    throw InputError("gradation: expected more than 1, found " + std::to_string(gradation));
  }
  require_positive_definite(node_metrics);
  const PointCells around = point_cells(mesh);
  const double log_gradation = std::log(gradation);
  // Sweep over the nodes with a neighbour that changed in the last sweep, all from the old values,
  // until none changes: every change makes a node's determinant grow.
  std::vector<Sym3> next(node_metrics.begin(), node_metrics.end());
  std::vector<char> active(n, 1), changed(n), ever_changed(n, 0);
  for (bool any = true; any;) {
    parallel_for(n, [&](std::size_t i) {
      changed[i] = 0;
      if (!active[i]) return;
      next[i] = limited({mesh, around, node_metrics}, static_cast<Index>(i), log_gradation);
      changed[i] = next[i] != node_metrics[i];
    });
    any = false;
    parallel_for(n, [&](std::size_t i) {
      const auto cells = around.of(static_cast<Index>(i));
      active[i] = std::any_of(cells.begin(), cells.end(), [&](Index cell) {
        const Cell& points = mesh.cells[cell];
        return std::any_of(points.begin(), points.end(), [&](Index p) { return changed[p]; });
      });
    });
    for (std::size_t i = 0; i < n; ++i) {
      if (!changed[i]) continue;
      any = true;
      ever_changed[i] = 1;
      node_metrics[i] = next[i];
    }
  }
  return std::accumulate(ever_changed.begin(), ever_changed.end(), std::int64_t{0});
}

}  // namespace mesamis::detail::mesh
