// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesamis/mesh/tet_mesh.h"
#include "mesamis/rooms.h"

namespace mesamis::detail::adapt {

/// Parameters of cell_metric().
struct CellMetricOptions {
  std::int64_t cell_count = 1;  ///< #T, the cells of the mesh estimated
  double tau = 1e-2;            ///< tolerance on the estimator, > 0
  double max_stretch = 10;      ///< bound on lambda_1 / lambda_3, roughly; > 1
};

/// Computes the metric that equidistributes the error with the fewest cells. Source: Prop. 3.2.
///
/// With g_i the eigenvalues of Gamma, the proposition's sizes give the eigenvalues
/// sqrt(sqrt(3) |K^| #T / tau) (g_1 g_2 g_3)^(-1/4) g_i, that is
///   M_K = sqrt(sqrt(3) |K^| #T / tau) det(Gamma)^(-1/4) Gamma,
/// without any decomposition.
///
/// Where u and v do not vary in some direction (walls that are the same in every slice) Gamma is
/// singular, and the formula gives cells of infinite length in that direction and zero thickness
/// across it. The domain is bounded, so that the stretch has to be: the share 1 / max_stretch^2 of
/// Gamma's trace is added to its diagonal, which bounds the ratio of the sizes. Where Gamma is
/// zero, or so small that its trace has no reciprocal, M_K is zero.
/// @param gamma  Gamma_K, symmetric positive semidefinite.
/// @return symmetric positive definite unless Gamma is zero; in 1 / u^2 for the unit of length u of
///         the mesh.
Sym3 cell_metric(const Sym3& gamma, const CellMetricOptions& options);

/// Predicts the number of cells of a mesh that is ideal in a metric, (11): the sum of
/// |K| sqrt(det M_K) / |K^|.
/// @param mesh          m cells.
/// @param cell_metrics  m symmetric positive semidefinite matrices, in 1 / u^2 for the unit of
///                      length u of the mesh.
/// @return cells, no unit.
/// @throws InputError   if the sizes differ; the message gives both.
///
/// The same bits for any number of threads.
double predicted_cells(const TetMesh& mesh, std::span<const Sym3> cell_metrics);

/// Averages one metric per cell onto the nodes, ready for the remesher.
///
/// Each node gets the volume-weighted mean over the cells around it, times 3/8: a cell
/// inscribed in the unit sphere of its metric becomes a cell with edges of length one.
/// Source: paper, sec. 3, definition of M_N after Prop. 3.2.
///
/// @param mesh          n nodes, m cells of positive volume.
/// @param cell_metrics  m symmetric positive semidefinite matrices, in 1 / u^2 for the unit of
///                      length u of the mesh.
/// @return n matrices in the unit of the cells' metrics; edge e is ideal when e'Me = 1.
/// @throws InputError   if the sizes differ; the message gives both.
///
/// Summed in cell order: the same bits for any number of threads.
std::vector<Sym3> node_metrics(const TetMesh& mesh, std::span<const Sym3> cell_metrics);

}  // namespace mesamis::detail::adapt
