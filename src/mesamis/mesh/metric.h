// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <span>
#include <vector>

#include "mesamis/base/types.h"
#include "mesamis/mesh/edges.h"
#include "mesamis/mesh/tet_mesh.h"

/// Metric tensors: symmetric positive definite, in 1/mm^2; edge e is ideal when e'Me = 1.
namespace mesamis {

/// @throws InputError  naming the caller, if there is not one metric per node.
void require_one_per_node(const char* caller, const TetMesh& mesh,
                          std::span<const Sym3> node_metrics);

/// @throws InputError  naming the first node whose metric is not finite or not positive definite.
void require_positive_definite(std::span<const Sym3> node_metrics);

/// Length of edge e (mm) between nodes with metrics ma and mb, for sizes that vary
/// geometrically along it: (la - lb) / log(la / lb). Source: UGAWG adaptation benchmarks.
double metric_length(const Sym3& ma, const Sym3& mb, const Vec3& e);

/// Mean ratio of a cell in metric m, 1 for the unit regular tetrahedron, 0 when not positive.
double metric_quality(const Sym3& m, const std::array<Vec3, 4>& p);

/// Log-Euclidean mean: exp(sum_i weights_i log m_i), weights adding up to 1.
Sym3 log_euclidean_mean(std::span<const Sym3> metrics, std::span<const double> weights);

/// The metric with its sizes (1/sqrt of the eigenvalues) clamped to [h_min, h_max], mm.
/// A singular or zero matrix is welcome: its flat directions get h_max.
Sym3 clamp_sizes(const Sym3& m, double h_min, double h_max);

/// The coarsest metric along the axes of both that is nowhere coarser than either: in the basis
/// that makes a the identity and b diagonal, the larger of each pair. Symmetric in a and b.
/// Source: F. Alauzet, P. Frey, Estimateur d'erreur geometrique et metriques anisotropes, 2003.
/// @param a, b  positive definite; aspects up to about 1e5, beyond it digits are lost.
Sym3 intersect(const Sym3& a, const Sym3& b);

/// Integral of sqrt(det M) over the mesh, the metric's determinant root taken linear per cell.
double complexity(const TetMesh& mesh, std::span<const Sym3> node_metrics);

/// How well a mesh fits a nodal metric; lengths and qualities as in the UGAWG benchmarks,
/// the cell's metric being that of its vertex with the largest determinant.
struct MeshFit {
  std::int64_t edges = 0;
  double unit_edge_fraction = 0;  ///< share of edges with length in [1/sqrt 2, sqrt 2]
  double length_min = 0, length_max = 0;
  Edge shortest{kNoIndex, kNoIndex}, longest{kNoIndex, kNoIndex};
  double quality_min = 0, quality_mean = 0;
  Index worst_cell = kNoIndex;
};
MeshFit measure_fit(const TetMesh& mesh, std::span<const Sym3> node_metrics);

}  // namespace mesamis
