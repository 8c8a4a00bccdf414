// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <span>
#include <vector>

#include "mesamis/adapt/cell_shape.h"
#include "mesamis/fem/functional.h"
#include "mesamis/mesh/tet_mesh.h"

/// The anisotropic a posteriori error estimator of Prop. 3.1, with recovered gradients.
namespace mesamis::detail::adapt {

/// Sums over the patch Delta_K (all cells that share a vertex with K) of one P1 function z.
struct PatchSums {
  double volume = 0;    ///< |Delta_K|
  Vec3 gradient;        ///< sum |T| grad z
  Sym3 gradient_outer;  ///< sum |T| grad z grad z^T
};

/// Computes the recovered error G^R: int over the patch of (R - grad z)(R - grad z)^T, R the
/// patch's mean gradient.
/// @param patch  of positive volume.
/// @return in the unit of z squared times the unit of the mesh.
Sym3 recovered_error(const PatchSums& patch);

/// The terms of rho^A and rho^B in the order of Prop. 3.1.
struct ResidualTerms {
  std::array<double, 5> a{};
  std::array<double, 3> b{};
  /// rho^A of Prop. 3.1: the sum of its terms, in the unit of the terms.
  double rho_a() const noexcept { return a[0] + a[1] + a[2] + a[3] + a[4]; }
  /// rho^B of Prop. 3.1: the sum of its terms, in the unit of the terms.
  double rho_b() const noexcept { return b[0] + b[1] + b[2]; }
};

/// The data of one cell that its residuals depend on.
struct CellData {
  double volume = 0;
  CellShape shape;
  std::array<double, 4> u{}, v{}, f{};       ///< nodal values
  Vec3 grad_u, grad_v, grad_f;               ///< constant gradients
  std::array<double, 4> face_area{};         ///< of the face opposite vertex i
  std::array<double, 4> jump_u{}, jump_v{};  ///< |[grad . n]| on it, boundary rule applied
};

/// Computes the residuals of one cell. Source: Prop. 3.1.
/// @param cell        of positive volume; grey values, lengths in the unit of the mesh.
/// @param parameters  valid, see require_valid().
ResidualTerms residual_terms(const CellData& cell, const AtParameters& parameters);

/// The estimate of one cell.
struct CellEstimate {
  ResidualTerms residuals;
  double zeta_a = 0, zeta_b = 0;  ///< rho^A omega(u) and rho^B omega(v); zeta_K (10) is their sum
  Sym3 gamma;                     ///< Gamma_K of Prop. 3.2
};

/// Estimates one cell. Source: (10) and Prop. 3.2.
/// @param cell              of positive volume; grey values, lengths in the unit of the mesh.
/// @param parameters        valid, see require_valid().
/// @param error_u, error_v  recovered_error() of u and v on the cell's patch.
CellEstimate estimate_cell(const CellData& cell, const AtParameters& parameters,
                           const Sym3& error_u, const Sym3& error_v);

/// Sums over cells.
struct EstimateSums {
  ResidualTerms residuals;        ///< each term
  double zeta_a = 0, zeta_b = 0;  ///< the two halves of the estimator

  /// The estimator, in the unit of its two halves.
  double zeta() const noexcept { return zeta_a + zeta_b; }
  /// Adds the terms of one cell.
  void add(const CellEstimate& cell);
  /// Adds the sums over other cells.
  void add(const EstimateSums& block);
};

/// The estimate of a mesh.
struct Estimate {
  std::vector<Sym3> gamma;   ///< Gamma_K, one per cell
  std::vector<double> zeta;  ///< zeta_K (10), one per cell
  EstimateSums sums;         ///< over the cells
};

/// Estimates the error of every cell of a mesh. Source: Prop. 3.1, with recovered gradients.
/// @param mesh    n nodes, m cells of positive volume.
/// @param fields  n values each: the minimisers on this mesh and the projected image.
/// @throws InputError  for sizes that differ, and as cell_neighbors().
///
/// O(m), in parallel; the same bits for any number of threads.
Estimate estimate(const TetMesh& mesh, const AtParameters& parameters, const AtFields& fields);

}  // namespace mesamis::detail::adapt
