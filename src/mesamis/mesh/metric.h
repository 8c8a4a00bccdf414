// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <span>
#include <vector>

#include "mesamis/base/types.h"
#include "mesamis/mesh/edges.h"
#include "mesamis/mesh/tet_mesh.h"

/// Metric tensors: symmetric positive definite, in 1/mm^2; edge e is ideal when e'Me = 1.
namespace mesamis::detail::mesh {

/// Checks that there is one metric per node. O(1): the cost is that of two sizes.
/// @param caller        who asks, for the message.
/// @param node_metrics  1/mm^2.
/// @throws InputError  with both sizes, if they differ.
void require_one_per_node(const char* caller, const TetMesh& mesh,
                          std::span<const Sym3> node_metrics);

/// Checks that every metric is finite and positive definite.
/// @param node_metrics  n matrices in 1/mm^2.
/// @throws InputError  naming the first node whose metric is not.
void require_positive_definite(std::span<const Sym3> node_metrics);

/// Length of edge e between nodes with metrics ma and mb, for sizes that vary geometrically along
/// it: (la - lb) / log(la / lb). Source: UGAWG adaptation benchmarks.
/// @param ma, mb  positive definite, 1/mm^2.
/// @param e       mm, not zero.
/// @return no unit: 1 for an ideal edge.
double metric_length(const Sym3& ma, const Sym3& mb, const Vec3& e);

/// Mean ratio of a cell in a metric: 12 (3 V)^(2/3) / sum of squared edges, all in the metric.
/// @param m  1/mm^2.
/// @param p  the cell's corners, mm.
/// @return no unit: 1 for a regular tetrahedron in the metric; 0 if the volume or det m is not
///         positive.
double metric_quality(const Sym3& m, const std::array<Vec3, 4>& p);

/// Log-Euclidean mean: exp(sum_i weights_i log m_i).
/// @param metrics  k positive definite matrices, 1/mm^2.
/// @param weights  k numbers with sum 1, no unit.
/// @return 1/mm^2.
Sym3 log_euclidean_mean(std::span<const Sym3> metrics, std::span<const double> weights);

/// Clamps the sizes of a metric, 1/sqrt of its eigenvalues, to [h_min, h_max].
/// @param m             symmetric, 1/mm^2; directions of a zero eigenvalue get h_max.
/// @param h_min, h_max  mm, 0 < h_min <= h_max.
/// @return positive definite, 1/mm^2.
Sym3 clamp_sizes(const Sym3& m, double h_min, double h_max);

/// The intersection of two metrics: the coarsest one along the axes of both that is nowhere coarser
/// than either. In the basis that makes a the identity and b diagonal it takes the larger of each
/// pair of eigenvalues. Symmetric in a and b.
/// Source: F. Alauzet, P. Frey, Estimateur d'erreur geometrique et metriques anisotropes, 2003.
/// @param a, b  positive definite, 1/mm^2; digits are lost beyond aspects of about 1e5.
/// @return positive definite, 1/mm^2.
Sym3 intersect(const Sym3& a, const Sym3& b);

/// The complexity of a metric: the integral of sqrt(det M) over the mesh, the root linear on each
/// cell.
/// @param mesh          n nodes, m cells, mm.
/// @param node_metrics  n matrices, 1/mm^2.
/// @return no unit; a unit mesh has about 9 cells per unit of it.
/// @throws InputError  if the sizes differ.
///
/// The same bits for any number of threads.
double complexity(const TetMesh& mesh, std::span<const Sym3> node_metrics);

/// How well a mesh fits a nodal metric. Lengths and qualities have no unit.
struct MeshFit {
  std::int64_t edges = 0;
  double unit_edge_fraction = 0;  ///< share of edges with length in [1/sqrt 2, sqrt 2]
  double length_min = 0, length_max = 0;
  Edge shortest{kNoIndex, kNoIndex}, longest{kNoIndex, kNoIndex};
  double quality_min = 0, quality_mean = 0;
  Index worst_cell = kNoIndex;
};

/// Measures metric_length() of every edge and metric_quality() of every cell, as the UGAWG
/// benchmarks do: the metric of a cell is that of its node with the largest determinant.
/// @param mesh          n nodes, m cells, mm.
/// @param node_metrics  n positive definite matrices, 1/mm^2.
/// @return all zero for a mesh without cells.
/// @throws InputError  if the sizes differ.
///
/// O(m), memory as unique_edges().
MeshFit measure_fit(const TetMesh& mesh, std::span<const Sym3> node_metrics);

}  // namespace mesamis::detail::mesh
