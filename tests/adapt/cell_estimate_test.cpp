// SPDX-License-Identifier: Apache-2.0
// What adapt/cell_estimate.cpp computes for one cell, see estimator.h.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "mesamis/adapt/estimator.h"
#include "mesamis/base/sym3.h"
#include "support/expect_near.h"

namespace mesamis {
namespace {

constexpr AtParameters kParameters{0.2, 0.05, 1.7, 3.1};
const std::array<Vec3, 4> kPoints{Vec3{0, 0, 0}, Vec3{1, 0.1, 0}, Vec3{0.2, 1.5, 0},
                                  Vec3{0.1, 0.3, 0.8}};

/// A cell on which u, v and f are linear and do not jump.
CellData cell_with(const std::array<double, 4>& u, const std::array<double, 4>& v,
                   const std::array<double, 4>& f) {
  CellData cell;
  cell.shape = cell_shape(kPoints);
  cell.volume = six_volume(kPoints[0], kPoints[1], kPoints[2], kPoints[3]) / 6;
  cell.u = u, cell.v = v, cell.f = f;
  for (std::size_t i = 0; i < 4; ++i) {
    const auto& [a, b, c] = kCellFaces[i];
    const Vec3 doubled = cross(kPoints[b] - kPoints[a], kPoints[c] - kPoints[a]);
    cell.face_area[i] = norm(doubled) / 2;
    // The gradient of vertex i's hat function points from the face opposite to it towards it.
    const Vec3 hat = (1 / dot(doubled, kPoints[i] - kPoints[a])) * doubled;
    cell.grad_u += u[i] * hat, cell.grad_v += v[i] * hat, cell.grad_f += f[i] * hat;
  }
  return cell;
}

TEST(ResidualTerms, VanishForAConstantImageWithoutEdges) {
  const ResidualTerms terms =
      residual_terms(cell_with({42, 42, 42, 42}, {1, 1, 1, 1}, {42, 42, 42, 42}), kParameters);
  for (const double a : terms.a) EXPECT_NEAR(a, 0, 1e-12);
  for (const double b : terms.b) EXPECT_NEAR(b, 0, 1e-12);
}

TEST(ResidualTerms, OfAConstantMisfitAreItsNorm) {
  const CellData cell = cell_with({45, 45, 45, 45}, {1, 1, 1, 1}, {42, 42, 42, 42});
  const ResidualTerms terms = residual_terms(cell, kParameters);
  EXPECT_NEAR(terms.a[0], 3 * std::sqrt(cell.volume), 1e-12);
  EXPECT_NEAR(terms.rho_a(), terms.a[0], 1e-12);
}

TEST(ResidualTerms, OfAConstantIndicatorAreTheWellsSlope) {
  // With grad u = 0 and v = 1/2 the v-equation leaves (1/2 - 1) gamma / (4 eps).
  const CellData cell = cell_with({42, 42, 42, 42}, {0.5, 0.5, 0.5, 0.5}, {42, 42, 42, 42});
  const ResidualTerms terms = residual_terms(cell, kParameters);
  const double well = kParameters.gamma / (4 * kParameters.epsilon);
  EXPECT_NEAR(terms.b[0], 0.5 * well * std::sqrt(cell.volume), 1e-12);
  EXPECT_NEAR(terms.rho_b(), terms.b[0], 1e-12);
}

/// The integral of (v^2 + eta)^2 over a triangle, v linear, by the midpoints of n^2 small ones.
double face_integral(double area, double a, double b, double c) {
  constexpr int n = 200;
  double sum = 0;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; i + j < n; ++j) {
      for (const double third : {1.0 / 3, 2.0 / 3}) {
        if (third > 0.5 && i + j + 1 >= n) continue;
        const double s = (i + third) / n, t = (j + third) / n;
        const double v = a + s * (b - a) + t * (c - a);
        sum += std::pow(v * v + kParameters.eta, 2);
      }
    }
  }
  return area * sum / (n * n);
}

TEST(ResidualTerms, OfAJumpHaveTheNormOnTheBoundaryByQuadrature) {
  CellData cell = cell_with({0, 0, 0, 0}, {0.1, 0.9, 0.4, 0.7}, {0, 0, 0, 0});
  cell.jump_u = {0.5, 2, 1, 0.3};
  double square = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    const auto& [a, b, c] = kCellFaces[i];
    square += face_integral(cell.face_area[i], cell.v[a], cell.v[b], cell.v[c]);
  }
  const auto& [l1, l2, l3] = cell.shape.lambda;
  const double expected = kParameters.beta / 2 * 2 * std::sqrt(square) *
                          std::sqrt(cell.shape.diameter / (l1 * l2 * l3));
  EXPECT_NEAR(residual_terms(cell, kParameters).a[2] / expected, 1, 1e-4);
}

TEST(ResidualTerms, OfTheImageAloneScaleWithIt) {
  const CellData once = cell_with({1, 5, -2, 3}, {1, 1, 1, 1}, {0, 2, 1, 7});
  const CellData twice = cell_with({2, 10, -4, 6}, {1, 1, 1, 1}, {0, 4, 2, 14});
  const ResidualTerms a = residual_terms(once, kParameters), b = residual_terms(twice, kParameters);
  for (std::size_t i = 0; i < 5; ++i) EXPECT_NEAR(b.a[i], 2 * a.a[i], 1e-11);
}

TEST(RecoveredError, IsTheSumOverThePatch) {
  std::mt19937 generator(3);
  std::uniform_real_distribution<double> uniform(-1, 1);
  std::vector<std::pair<double, Vec3>> cells;
  PatchSums patch;
  for (int n = 0; n < 12; ++n) {
    const double volume = 1.5 + uniform(generator);
    const Vec3 g{uniform(generator), uniform(generator), uniform(generator)};
    cells.emplace_back(volume, g);
    patch.volume += volume;
    patch.gradient += volume * g;
    patch.gradient_outer += volume * outer(g);
  }
  const Vec3 mean = (1 / patch.volume) * patch.gradient;
  Sym3 expected;
  for (const auto& [volume, g] : cells) expected += volume * outer(mean - g);
  expect_near(recovered_error(patch), expected, 1e-12);
}

TEST(RecoveredError, VanishesForOneGradient) {
  const Vec3 g{3, -1, 2};
  expect_near(recovered_error({2.5, 2.5 * g, 2.5 * outer(g)}), Sym3{}, 1e-12);
}

TEST(EstimateCell, IsTheResidualTimesItsWeight) {
  const CellData cell = cell_with({1, 5, -2, 3}, {0.2, 0.9, 0.4, 0.6}, {0, 2, 1, 7});
  const Sym3 error_u = outer({1, 2, -1}), error_v = outer({0.1, 0, 0.3});
  const CellEstimate e = estimate_cell(cell, kParameters, error_u, error_v);
  // omega(z)^2 = sum lambda_i^2 r_i' G r_i, by the eigenvectors.
  const SymEigen shape = eigen_decompose(cell.shape.stretch_squared);
  double square = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    square += shape.values[i] * quadratic_form(error_u, shape.vectors[i]);
  }
  EXPECT_NEAR(e.zeta_a / (e.residuals.rho_a() * std::sqrt(square)), 1, 1e-12);
  const double per_volume = 1 / (cell.volume * cell.volume);
  const double a = e.residuals.rho_a(), b = e.residuals.rho_b();
  expect_near(e.gamma, per_volume * (a * a * error_u + b * b * error_v), 1e-9 * trace(e.gamma));
  EXPECT_GE(eigen_decompose(e.gamma).values[2], -1e-12 * trace(e.gamma));
}

TEST(EstimateSums, AddUpCellsAndBlocks) {
  const CellEstimate e = estimate_cell(cell_with({1, 5, -2, 3}, {0.2, 0.9, 0.4, 0.6}, {0, 2, 1, 7}),
                                       kParameters, kIdentity3, kIdentity3);
  EstimateSums one, two;
  one.add(e);
  two.add(one);
  two.add(e);
  EXPECT_DOUBLE_EQ(two.zeta(), 2 * one.zeta());
  EXPECT_DOUBLE_EQ(one.zeta(), e.zeta_a + e.zeta_b);
  EXPECT_DOUBLE_EQ(two.residuals.rho_a(), 2 * e.residuals.rho_a());
  EXPECT_DOUBLE_EQ(two.residuals.rho_b(), 2 * e.residuals.rho_b());
}

}  // namespace
}  // namespace mesamis
