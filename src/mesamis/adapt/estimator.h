// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <span>
#include <vector>

#include "mesamis/mesh/tet_mesh.h"
#include "mesamis/segment/functional.h"

/// The anisotropic a posteriori error estimator of Prop. 3.1, with recovered gradients.
namespace mesamis {

/// Volume of the regular tetrahedron inscribed in the unit sphere, |K^| = 8 sqrt(3) / 27.
inline constexpr double kReferenceVolume = 0.5132002392796673;

/// A cell as the image of the reference tetrahedron: semi-axes of its ellipsoid and diameter.
struct CellShape {
  std::array<double, 3> lambda;  ///< lambda_1 >= lambda_2 >= lambda_3 > 0
  Sym3 stretch_squared;          ///< M_K M_K^T = sum lambda_i^2 r_i r_i^T
  double diameter;               ///< h_K, longest edge
};
CellShape cell_shape(const std::array<Vec3, 4>& points);

/// The three aspect ratios (6): s1 >= s2 >= s3, s1 s2 s3 = 1.
std::array<double, 3> aspect_ratios(const CellShape& shape);

/// Sums over the patch Delta_K (all cells that share a vertex with K) of one P1 function z.
struct PatchSums {
  double volume = 0;    ///< |Delta_K|
  Vec3 gradient;        ///< sum |T| grad z
  Sym3 gradient_outer;  ///< sum |T| grad z grad z^T
};

/// G^R: int over the patch of (R - grad z)(R - grad z)^T, R the patch's mean gradient.
Sym3 recovered_error(const PatchSums& patch);

/// The terms of rho^A and rho^B in the order of Prop. 3.1, for inspection.
struct ResidualTerms {
  std::array<double, 5> a{};
  std::array<double, 3> b{};
  double rho_a() const { return a[0] + a[1] + a[2] + a[3] + a[4]; }
  double rho_b() const { return b[0] + b[1] + b[2]; }
};

/// What the residuals of one cell depend on.
struct CellData {
  double volume = 0;
  CellShape shape;
  std::array<double, 4> u{}, v{}, f{};       ///< nodal values
  Vec3 grad_u, grad_v, grad_f;               ///< constant gradients
  std::array<double, 4> face_area{};         ///< of the face opposite vertex i
  std::array<double, 4> jump_u{}, jump_v{};  ///< |[grad . n]| on it, boundary rule applied
};
ResidualTerms residual_terms(const CellData& cell, const AtParameters& parameters);

/// What the estimator says about one cell.
struct CellEstimate {
  ResidualTerms residuals;
  double zeta_a = 0, zeta_b = 0;  ///< rho^A omega(u) and rho^B omega(v); zeta_K (10) is their sum
  Sym3 gamma;                     ///< Gamma_K of Prop. 3.2
};
CellEstimate estimate_cell(const CellData& cell, const AtParameters& parameters,
                           const Sym3& error_u, const Sym3& error_v);

/// What many cells add up to.
struct EstimateSums {
  ResidualTerms residuals;        ///< each term
  double zeta_a = 0, zeta_b = 0;  ///< the two halves of the estimator

  double zeta() const { return zeta_a + zeta_b; }
  void add(const CellEstimate& cell);
  void add(const EstimateSums& block);
};

/// What it says about a mesh.
struct Estimate {
  std::vector<Sym3> gamma;   ///< Gamma_K, one per cell
  std::vector<double> zeta;  ///< zeta_K (10), one per cell
  EstimateSums sums;         ///< over the cells
};

/// Estimates every cell of a mesh.
/// @param u, v, f  nodal values, f being the projected image.
/// @throws InputError  for sizes that differ.
/// O(m), in parallel; the same bits for any number of threads.
Estimate estimate(const TetMesh& mesh, const AtParameters& parameters, std::span<const double> u,
                  std::span<const double> v, std::span<const double> f);

}  // namespace mesamis
