// SPDX-License-Identifier: Apache-2.0
#include "mesamis/fem/mesh_space.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "mesamis/fem/solve.h"
#include "support/perturbed_box.h"

namespace mesamis {
namespace {

TEST(MeshSpace, GradientsOfLinearFieldsAreExact) {
  const TetMesh mesh = perturbed_box({{0, 0, 0}, {1, 2, 3}}, {3, 4, 5}, 0.3);
  std::vector<double> u;
  for (const Vec3& p : mesh.points) u.push_back(4 - 2 * p.x + 3 * p.y + 0.5 * p.z);
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    const CellGeometry g = cell_geometry(mesh, static_cast<Index>(c));
    EXPECT_NEAR(norm(cell_gradient(g, mesh.cells[c], u) - Vec3{-2, 3, 0.5}), 0, 1e-11);
    EXPECT_NEAR(g.volume, cell_volume(mesh, static_cast<Index>(c)), 1e-15);
  }
}

TEST(MeshSpace, MassesAddUpToTheVolume) {
  const TetMesh mesh = perturbed_box({{0, 0, 0}, {1, 2, 3}}, {3, 4, 5}, 0.3);
  const MeshSpace space(mesh);
  const auto& m = space.lumped_mass();
  EXPECT_NEAR(std::accumulate(m.begin(), m.end(), 0.0), 6, 1e-12);
  const MatrixOperator mass = space.consistent_mass();
  std::vector<double> one(mesh.points.size(), 1), rows(one.size());
  mass.apply(one, rows);
  for (std::size_t n = 0; n < rows.size(); ++n) EXPECT_NEAR(rows[n], m[n], 1e-14);
}

TEST(MeshSpace, StiffnessKnowsNoConstantAndIsSymmetric) {
  const TetMesh mesh = perturbed_box({{0, 0, 0}, {1, 1, 1}}, {3, 3, 3}, 0.3);
  const MeshSpace space(mesh);
  const std::size_t n = mesh.points.size();
  std::vector<double> w(n), x(n), y(n), ax(n), ay(n);
  for (std::size_t i = 0; i < n; ++i) {
    const double t = static_cast<double>(i);
    w[i] = 1 + std::sin(t);
    x[i] = std::cos(3 * t);
    y[i] = std::sin(5 * t);
  }
  const auto a = space.diffusion(w, 2, 0.1, std::vector<double>(n, 0));
  a->apply(std::vector<double>(n, 7), ax);
  for (const double value : ax) EXPECT_NEAR(value, 0, 1e-12);
  a->apply(x, ax);
  a->apply(y, ay);
  EXPECT_NEAR(std::inner_product(y.begin(), y.end(), ax.begin(), 0.0),
              std::inner_product(x.begin(), x.end(), ay.begin(), 0.0), 1e-11);
}

TEST(MeshSpace, GradientSquaresAreTheDirichletForm) {
  const TetMesh mesh = perturbed_box({{0, 0, 0}, {1, 1, 1}}, {3, 3, 3}, 0.3);
  const MeshSpace space(mesh);
  const std::size_t n = mesh.points.size();
  std::vector<double> u(n), w(n), au(n);
  for (std::size_t i = 0; i < n; ++i) {
    u[i] = std::cos(2.0 * static_cast<double>(i));
    w[i] = 0.5 + 0.5 * std::sin(static_cast<double>(i));
  }
  space.diffusion(w, 1, 0, std::vector<double>(n, 0))->apply(u, au);
  const auto squares = space.gradient_squares(u);
  EXPECT_NEAR(std::inner_product(u.begin(), u.end(), au.begin(), 0.0),
              std::inner_product(w.begin(), w.end(), squares.begin(), 0.0), 1e-11);
}

/// Solves u - div grad u = g with u = cos(pi x) cos(pi y) cos(pi z), natural boundary.
double l2_error(Index n) {
  const TetMesh mesh = perturbed_box({{0, 0, 0}, {1, 1, 1}}, {n, n, n}, 0.1);
  const MeshSpace space(mesh);
  const double pi = std::acos(-1.0);
  std::vector<double> exact, right;
  for (std::size_t i = 0; i < mesh.points.size(); ++i) {
    const Vec3& p = mesh.points[i];
    exact.push_back(std::cos(pi * p.x) * std::cos(pi * p.y) * std::cos(pi * p.z));
    right.push_back(space.lumped_mass()[i] * (1 + 3 * pi * pi) * exact.back());
  }
  std::vector<double> u(exact.size(), 0);
  solve(*space.diffusion({}, 0, 1, space.lumped_mass()), right, u, {1e-11, 2000, 2000});
  double error = 0;
  for (std::size_t i = 0; i < u.size(); ++i) {
    error += space.lumped_mass()[i] * std::pow(u[i] - exact[i], 2);
  }
  return std::sqrt(error);
}

TEST(MeshSpace, ConvergesAtSecondOrder) {
  const double rate = std::log2(l2_error(8) / l2_error(16));
  EXPECT_GT(rate, 1.7);
  EXPECT_LT(rate, 2.3);
}

}  // namespace
}  // namespace mesamis
