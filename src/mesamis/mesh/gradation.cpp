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
#include "mesamis/mesh/edges.h"
#include "mesamis/mesh/metric.h"

namespace mesamis {
namespace {

/// The neighbours of node n are nodes[start[n]] ... nodes[start[n + 1] - 1].
struct Neighbors {
  std::vector<std::size_t> start;
  std::vector<Index> nodes;
  std::span<const Index> of(std::size_t n) const {
    return {nodes.data() + start[n], nodes.data() + start[n + 1]};
  }
};

Neighbors find_neighbors(const TetMesh& mesh) {
  const std::vector<Edge> edges = unique_edges(mesh);
  Neighbors result{std::vector<std::size_t>(mesh.points.size() + 1, 0),
                   std::vector<Index>(2 * edges.size())};
  for (const auto& [a, b] : edges) {
    ++result.start[static_cast<std::size_t>(a) + 1];
    ++result.start[static_cast<std::size_t>(b) + 1];
  }
  std::partial_sum(result.start.begin(), result.start.end(), result.start.begin());
  std::vector<std::size_t> next(result.start.begin(), result.start.end() - 1);
  for (const auto& [a, b] : edges) {
    result.nodes[next[static_cast<std::size_t>(a)]++] = b;
    result.nodes[next[static_cast<std::size_t>(b)]++] = a;
  }
  return result;
}

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

/// What a node's neighbours leave of its metric.
Sym3 limited(const TetMesh& mesh, std::span<const Sym3> metrics, std::size_t n,
             std::span<const Index> neighbors, double log_gradation) {
  constexpr double kSlack = 1.002;  // of a squared size: less is not worth a change
  constexpr double kLeastGrowth = 1.001;
  Sym3 m = metrics[n];
  for (const Index other : neighbors) {
    const Vec3 e = mesh.points[n] - mesh.points[other];
    const Sym3 bound = grown(metrics[other], e, log_gradation);
    if (exceeds(kSlack * m, bound)) continue;
    const Sym3 finer = intersect(m, bound);
    // What round-off makes of flat metrics is no change.
    if (determinant(finer) > kLeastGrowth * determinant(m)) m = finer;
  }
  return m;
}

void require_metric(const Sym3& m, std::size_t node) {
  if (std::isfinite(trace(m) + m.xy + m.xz + m.yz) && eigen_decompose(m).values[2] > 0) return;
  throw InputError("gradation: expected a positive definite metric at node " +
                   std::to_string(node) + " (the first is 0)");
}

}  // namespace

std::int64_t limit_gradation(const TetMesh& mesh, std::span<Sym3> node_metrics, double gradation) {
  const std::size_t n = mesh.points.size();
  if (node_metrics.size() != n) {
    throw InputError("gradation: " + std::to_string(node_metrics.size()) + " metrics for " +
                     std::to_string(n) + " nodes");
  }
  if (!(gradation > 1)) {
    throw InputError("gradation: expected more than 1, found " + std::to_string(gradation));
  }
  for (std::size_t i = 0; i < n; ++i) require_metric(node_metrics[i], i);
  const Neighbors neighbors = find_neighbors(mesh);
  const double log_gradation = std::log(gradation);
  // Sweep over the nodes with a neighbour that changed in the last sweep, all from the old values,
  // until none changes: every change makes a node's determinant grow.
  std::vector<Sym3> next(node_metrics.begin(), node_metrics.end());
  std::vector<char> active(n, 1), changed(n), ever_changed(n, 0);
  for (bool any = true; any;) {
    parallel_for(n, [&](std::size_t i) {
      changed[i] = 0;
      if (!active[i]) return;
      next[i] = limited(mesh, node_metrics, i, neighbors.of(i), log_gradation);
      changed[i] = next[i] != node_metrics[i];
    });
    any = false;
    parallel_for(n, [&](std::size_t i) {
      const auto around = neighbors.of(i);
      active[i] = std::any_of(around.begin(), around.end(), [&](Index other) {
        return changed[static_cast<std::size_t>(other)];
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

}  // namespace mesamis
