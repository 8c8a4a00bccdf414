// SPDX-License-Identifier: Apache-2.0
#include "mesamis/fem/solve.h"

#include <gtest/gtest.h>

#include <cmath>

#include "mesamis/fem/grid_space.h"
#include "mesamis/fem/mesh_space.h"
#include "support/perturbed_box.h"

namespace mesamis {
namespace {

/// An edge indicator with insulating walls: 1, but close to 0 on a spherical shell.
double indicator(const Vec3& p, double size) {
  const double distance = norm(p - Vec3{size / 2, size / 2, size / 2}) - size / 4;
  return std::abs(distance) < 0.8 ? 0.01 : 1;
}

struct System {
  std::unique_ptr<SpdOperator> a;
  std::vector<double> b;
};

System u_step(const P1Space& space, const std::vector<Vec3>& points, double size, double beta) {
  std::vector<double> v_squared, b;
  for (std::size_t i = 0; i < points.size(); ++i) {
    v_squared.push_back(std::pow(indicator(points[i], size), 2));
    b.push_back(space.lumped_mass()[i] * 100 * (1 + std::sin(3.0 * static_cast<double>(i))));
  }
  return {space.diffusion(v_squared, beta, beta * 1e-6, space.lumped_mass()), b};
}

int iterations(const System& system) {
  std::vector<double> x(system.b.size(), 0);
  const SolveReport report = solve(*system.a, system.b, x, {.tolerance = 1e-8});
  EXPECT_TRUE(report.converged);
  std::vector<double> ax(x.size());
  system.a->apply(x, ax);
  double residual = 0, scale = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    residual += std::pow(system.b[i] - ax[i], 2);
    scale += std::pow(system.b[i], 2);
  }
  EXPECT_LT(std::sqrt(residual / scale), 2e-8);
  return report.iterations;
}

TEST(Solve, HoldsForBetaAThousandTimesTheDefault) {
  const Index n = 32;
  const KuhnGrid grid{{n + 1, n + 1, n + 1}, {1, 1, 1}};
  const auto points = box_mesh(grid.box(), {n, n, n}).points;
  const GridSpace space(grid);
  const int jacobi = SolveOptions{}.jacobi_iterations;
  EXPECT_LT(iterations(u_step(space, points, n, 2)), jacobi);
  EXPECT_LT(iterations(u_step(space, points, n, 2000)), jacobi + 60);
  EXPECT_LT(iterations(u_step(space, points, n, 2e6)), jacobi + 60);
}

TEST(Solve, HoldsOnStretchedCells) {
  const Box box{{0, 0, 0}, {16, 16, 16}};
  TetMesh mesh = perturbed_box(box, {12, 12, 12}, 0.2);
  // Pulled together towards the middle plane: cells a hundred times flatter there.
  for (Vec3& p : mesh.points) {
    const double t = (p.x - 8) / 8;
    p.x = 8 + 8 * (0.01 * t + 0.99 * t * t * t);
  }
  const MeshSpace space(mesh);
  for (const double beta : {2.0, 2000.0}) {
    EXPECT_LT(iterations(u_step(space, mesh.points, 16, beta)), 200);
  }
}

TEST(Solve, AnExactFirstGuessNeedsNoIteration) {
  const GridSpace space({{4, 4, 4}, {1, 1, 1}});
  const auto a = space.diffusion({}, 0, 1, space.lumped_mass());
  std::vector<double> x(64, 3), b(64);
  a->apply(x, b);
  const SolveReport report = solve(*a, b, x);
  EXPECT_EQ(report.iterations, 0);
  EXPECT_TRUE(report.converged);
}

TEST(Solve, AZeroRightSideGivesZero) {
  const GridSpace space({{4, 4, 4}, {1, 1, 1}});
  std::vector<double> x(64, 3);
  solve(*space.diffusion({}, 0, 1, space.lumped_mass()), std::vector<double>(64, 0), x);
  for (const double value : x) EXPECT_EQ(value, 0);
}

TEST(Solve, SaysWhenItDidNotConverge) {
  const Index n = 16;
  const KuhnGrid grid{{n + 1, n + 1, n + 1}, {1, 1, 1}};
  const System s = u_step(GridSpace(grid), box_mesh(grid.box(), {n, n, n}).points, n, 2000);
  std::vector<double> x(s.b.size(), 0);
  const SolveReport report = solve(*s.a, s.b, x, {1e-10, 3, 60});
  EXPECT_FALSE(report.converged);
  EXPECT_EQ(report.iterations, 3);
  EXPECT_GT(report.residual, 1e-10);
}

}  // namespace
}  // namespace mesamis
