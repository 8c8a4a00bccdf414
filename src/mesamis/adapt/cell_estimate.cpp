// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "mesamis/adapt/estimator.h"

namespace mesamis::detail::adapt {
namespace {

/// int_K z^2 / |K| for z linear with these nodal values.
double mean_square(const std::array<double, 4>& z) {
  const double sum = z[0] + z[1] + z[2] + z[3];
  return (z[0] * z[0] + z[1] * z[1] + z[2] * z[2] + z[3] * z[3] + sum * sum) / 20;
}

/// int_F (v^2 + eta)^2 / |F| for v linear on a triangle: with h_n the complete homogeneous
/// polynomial of the nodal values, int_F v^n = 2 |F| n! / (n + 2)! h_n.
double mean_square_of_v2_plus(double eta, double a, double b, double c) {
  std::array<double, 5> h{1};  // of a alone, then of a and b, then of all three
  for (std::size_t n = 1; n < 5; ++n) h[n] = a * h[n - 1];
  for (std::size_t n = 1; n < 5; ++n) h[n] += b * h[n - 1];
  for (std::size_t n = 1; n < 5; ++n) h[n] += c * h[n - 1];
  return h[4] / 15 + 2 * eta * h[2] / 6 + eta * eta;
}

/// ||v^2 + eta||_L2 over the four faces.
double boundary_norm_of_v2_plus(double eta, const CellData& k) {
  double square = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    const auto& [p, q, r] = kCellFaces[i];
    square += k.face_area[i] * mean_square_of_v2_plus(eta, k.v[p], k.v[q], k.v[r]);
  }
  return std::sqrt(square);
}

double boundary_norm_of_jump(const CellData& k) {
  double square = 0;
  for (std::size_t i = 0; i < 4; ++i) square += k.face_area[i] * k.jump_v[i] * k.jump_v[i];
  return std::sqrt(square);
}

void add_terms(const ResidualTerms& terms, ResidualTerms& sums) {
  for (std::size_t i = 0; i < terms.a.size(); ++i) sums.a[i] += terms.a[i];
  for (std::size_t i = 0; i < terms.b.size(); ++i) sums.b[i] += terms.b[i];
}

/// omega(z) of (8) with the recovered error: sqrt(sum lambda_i^2 r_i' G r_i) = sqrt(MM' : G).
double weight(const Sym3& stretch_squared, const Sym3& error) {
  const Sym3 &m = stretch_squared, &g = error;
  const double square =
      m.xx * g.xx + m.yy * g.yy + m.zz * g.zz + 2 * (m.xy * g.xy + m.xz * g.xz + m.yz * g.yz);
  return std::sqrt(std::max(square, 0.0));
}

}  // namespace

Sym3 recovered_error(const PatchSums& patch) {
  return patch.gradient_outer - (1 / patch.volume) * outer(patch.gradient);
}

ResidualTerms residual_terms(const CellData& k, const AtParameters& parameters) {
  const auto& [epsilon, eta, beta, gamma] = parameters;
  const auto& [l1, l2, l3] = k.shape.lambda;
  const double root_volume = std::sqrt(k.volume);
  const double trace_factor = std::sqrt(k.shape.diameter / (l1 * l2 * l3));
  const double interpolation_factor = k.shape.diameter * k.shape.diameter / l3;
  const double well = gamma / (4 * epsilon);
  const double absorption = beta * dot(k.grad_u, k.grad_u) + well;
  const auto [v_min, v_max] = std::minmax_element(k.v.begin(), k.v.end());
  std::array<double, 4> misfit{}, equation_v{};
  for (std::size_t i = 0; i < 4; ++i) {
    misfit[i] = k.u[i] - k.f[i];
    equation_v[i] = absorption * k.v[i] - well;
  }
  ResidualTerms terms;
  terms.a[0] = root_volume * std::sqrt(mean_square(misfit));
  terms.a[1] =
      2 * beta * std::abs(dot(k.grad_v, k.grad_u)) * root_volume * std::sqrt(mean_square(k.v));
  terms.a[2] = beta / 2 * *std::max_element(k.jump_u.begin(), k.jump_u.end()) *
               boundary_norm_of_v2_plus(eta, k) * trace_factor;
  terms.a[3] = (*v_max - *v_min) * (*v_max - *v_min) / 4 / l3 * norm(k.grad_u) * root_volume;
  terms.a[4] = interpolation_factor * norm(k.grad_u - k.grad_f);
  terms.b[0] = root_volume * std::sqrt(mean_square(equation_v));
  terms.b[1] = gamma * epsilon / 2 * boundary_norm_of_jump(k) * trace_factor;
  terms.b[2] = interpolation_factor * absorption * root_volume * norm(k.grad_v);
  return terms;
}

CellEstimate estimate_cell(const CellData& cell, const AtParameters& parameters,
                           const Sym3& error_u, const Sym3& error_v) {
  CellEstimate e;
  e.residuals = residual_terms(cell, parameters);
  const double rho_a = e.residuals.rho_a(), rho_b = e.residuals.rho_b();
  e.zeta_a = rho_a * weight(cell.shape.stretch_squared, error_u);
  e.zeta_b = rho_b * weight(cell.shape.stretch_squared, error_v);
  // rho-bar squared and G-bar each carry 1/|K|.
  const double per_volume_squared = 1 / (cell.volume * cell.volume);
  e.gamma = per_volume_squared * (rho_a * rho_a * error_u + rho_b * rho_b * error_v);
  return e;
}

void EstimateSums::add(const CellEstimate& cell) {
  add_terms(cell.residuals, residuals);
  zeta_a += cell.zeta_a;
  zeta_b += cell.zeta_b;
}

void EstimateSums::add(const EstimateSums& block) {
  add_terms(block.residuals, residuals);
  zeta_a += block.zeta_a;
  zeta_b += block.zeta_b;
}

}  // namespace mesamis::detail::adapt
