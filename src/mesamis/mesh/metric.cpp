// SPDX-License-Identifier: Apache-2.0
#include "mesamis/mesh/metric.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "mesamis/base/error.h"
#include "mesamis/base/parallel.h"
#include "mesamis/base/sym3.h"

namespace mesamis::detail::mesh {
namespace {

/// s m s
Sym3 congruent(const Sym3& s, const Sym3& m) {
  const Vec3 x = s * (m * (s * Vec3{1, 0, 0})), y = s * (m * (s * Vec3{0, 1, 0})),
             z = s * (m * (s * Vec3{0, 0, 1}));
  return {x.x, (x.y + y.x) / 2, (x.z + z.x) / 2, y.y, (y.z + z.y) / 2, z.z};
}

void measure_edges(const TetMesh& mesh, std::span<const Sym3> node_metrics, MeshFit& fit) {
  const std::vector<Edge> edges = unique_edges(mesh);
  if (edges.empty()) return;
  fit.edges = static_cast<std::int64_t>(edges.size());
  fit.length_min = std::numeric_limits<double>::infinity();
  fit.shortest = fit.longest = edges.front();
  std::int64_t unit = 0;
  for (const Edge& edge : edges) {
    const auto [a, b] = edge;
    const double length =
        metric_length(node_metrics[a], node_metrics[b], mesh.points[b] - mesh.points[a]);
    unit += length >= std::sqrt(0.5) && length <= std::sqrt(2.0);
    if (length < fit.length_min) {
      fit.length_min = length;
      fit.shortest = edge;
    }
    if (length > fit.length_max) {
      fit.length_max = length;
      fit.longest = edge;
    }
  }
  fit.unit_edge_fraction = static_cast<double>(unit) / static_cast<double>(edges.size());
}

void measure_cells(const TetMesh& mesh, std::span<const Sym3> node_metrics, MeshFit& fit) {
  if (mesh.cells.empty()) return;
  fit.quality_min = std::numeric_limits<double>::infinity();
  fit.worst_cell = 0;
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    const Cell& cell = mesh.cells[c];
    Index finest = cell[0];
    for (const Index n : cell) {
      if (determinant(node_metrics[n]) > determinant(node_metrics[finest])) finest = n;
    }
    const double quality = metric_quality(node_metrics[finest], cell_corners(mesh, cell));
    fit.quality_mean += quality / static_cast<double>(mesh.cells.size());
    if (!(quality < fit.quality_min)) continue;
    fit.quality_min = quality;
    fit.worst_cell = static_cast<Index>(c);
  }
}

}  // namespace

void require_one_per_node(const char* caller, const TetMesh& mesh,
                          std::span<const Sym3> node_metrics) {
  if (node_metrics.size() == mesh.points.size()) return;
  throw InputError(std::string(caller) + ": " + std::to_string(node_metrics.size()) +
                   " metrics for " + std::to_string(mesh.points.size()) + " nodes");
}

void require_positive_definite(std::span<const Sym3> node_metrics) {
  for (std::size_t n = 0; n < node_metrics.size(); ++n) {
    const Sym3& m = node_metrics[n];
    const bool finite = std::isfinite(m.xx) && std::isfinite(m.xy) && std::isfinite(m.xz) &&
                        std::isfinite(m.yy) && std::isfinite(m.yz) && std::isfinite(m.zz);
    if (finite && eigen_decompose(m).values[2] > 0) continue;
    throw InputError("metric: node " + std::to_string(n) + " (the first is 0) is not " +
                     (finite ? "positive definite" : "finite"));
  }
}

double metric_length(const Sym3& ma, const Sym3& mb, const Vec3& e) {
  const double la = std::sqrt(quadratic_form(ma, e));
  const double lb = std::sqrt(quadratic_form(mb, e));
  // Close to equal, the quotient loses digits and the mean is as good.
  if (std::abs(la - lb) <= 1e-3 * std::max(la, lb)) return 0.5 * (la + lb);
  return (la - lb) / std::log(la / lb);
}

double metric_quality(const Sym3& m, const std::array<Vec3, 4>& p) {
  const double volume = six_volume(p[0], p[1], p[2], p[3]) / 6;
  const double det = determinant(m);
  if (volume <= 0 || det <= 0) return 0;
  double squares = 0;
  for (const auto& [i, j] : kCellEdges) squares += quadratic_form(m, p[j] - p[i]);
  const double unit_volumes = volume * std::sqrt(det) * 6 * std::sqrt(2.0);
  return std::cbrt(unit_volumes * unit_volumes) / (squares / 6);
}

Sym3 log_euclidean_mean(std::span<const Sym3> metrics, std::span<const double> weights) {
  Sym3 mean;
  for (std::size_t i = 0; i < metrics.size(); ++i) mean += weights[i] * log_spd(metrics[i]);
  return exp_sym(mean);
}

Sym3 clamp_sizes(const Sym3& m, double h_min, double h_max) {
  SymEigen e = eigen_decompose(m);
  for (double& value : e.values) {
    value = std::clamp(value, 1 / (h_max * h_max), 1 / (h_min * h_min));
  }
  return compose(e.values, e.vectors);
}

Sym3 intersect(const Sym3& a, const Sym3& b) {
  const SymEigen e = eigen_decompose(a);
  std::array<double, 3> roots{}, inverse_roots{};
  for (std::size_t i = 0; i < 3; ++i) {
    roots[i] = std::sqrt(e.values[i]);
    inverse_roots[i] = 1 / roots[i];
  }
  SymEigen relative = eigen_decompose(congruent(compose(inverse_roots, e.vectors), b));
  for (double& value : relative.values) value = std::max(value, 1.0);
  return congruent(compose(roots, e.vectors), compose(relative.values, relative.vectors));
}

double complexity(const TetMesh& mesh, std::span<const Sym3> node_metrics) {
  require_one_per_node("complexity", mesh, node_metrics);
  return parallel_sum(mesh.cells.size(), [&](std::size_t begin, std::size_t end) {
    double sum = 0;
    for (std::size_t c = begin; c < end; ++c) {
      double roots = 0;
      for (const Index n : mesh.cells[c]) roots += std::sqrt(determinant(node_metrics[n]));
      sum += cell_volume(mesh, static_cast<Index>(c)) * roots / 4;
    }
    return sum;
  });
}

MeshFit measure_fit(const TetMesh& mesh, std::span<const Sym3> node_metrics) {
  require_one_per_node("mesh fit", mesh, node_metrics);
  MeshFit fit;
  measure_edges(mesh, node_metrics, fit);
  measure_cells(mesh, node_metrics, fit);
  return fit;
}

}  // namespace mesamis::detail::mesh
