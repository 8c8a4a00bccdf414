// SPDX-License-Identifier: Apache-2.0
#include "mesamis/fem/multigrid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "mesamis/base/parallel.h"
#include "mesamis/fem/grid_space.h"
#include "mesamis/fem/mesh_space.h"
#include "mesamis/fem/solve.h"
#include "support/dense_matrix.h"
#include "support/perturbed_box.h"

namespace mesamis {
namespace {

std::vector<double> wave(std::size_t n, double frequency) {
  std::vector<double> values;
  for (std::size_t i = 0; i < n; ++i) values.push_back(std::sin(frequency * double(i)));
  return values;
}

double inner(const std::vector<double>& a, const std::vector<double>& b) {
  return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
}

/// Nearly the Laplacian: what Jacobi is slow on.
std::unique_ptr<SpdOperator> stiff(const P1Space& space, double diffusion) {
  return space.diffusion({}, 0, diffusion, space.lumped_mass());
}

/// By multigrid from the first step.
SolveReport solve_by_multigrid(const SpdOperator& a, const std::vector<double>& b,
                               std::vector<double>& x, double tolerance) {
  return solve(a, b, x, {.tolerance = tolerance, .max_iterations = 500, .jacobi_iterations = 0});
}

int iterations(const P1Space& space) {
  const auto a = stiff(space, 1e6);
  const std::vector<double> b = wave(a->size(), 7);
  std::vector<double> x(b.size(), 0);
  const SolveReport report = solve_by_multigrid(*a, b, x, 1e-8);
  EXPECT_TRUE(report.converged);
  return report.iterations;
}

TEST(Multigrid, ConvergesIndependentlyOfTheGridsSize) {
  const auto on_grid = [](Index n) { return iterations(GridSpace({{n, n, n}, {1, 1, 1}})); };
  const int coarse = on_grid(12), middle = on_grid(24), fine = on_grid(48);
  // Jacobi's count doubles with each halving of the cells.
  EXPECT_LE(middle, 1.5 * coarse);
  EXPECT_LE(fine, 1.5 * middle);
  EXPECT_LE(fine, 1.75 * coarse);
}

TEST(Multigrid, ConvergesIndependentlyOfTheMeshsSize) {
  const auto on_mesh = [](Index n) {
    const TetMesh mesh = perturbed_box({{0, 0, 0}, {1, 1, 1}}, {n, n, n}, 0.2);
    return iterations(MeshSpace(mesh));
  };
  EXPECT_LE(on_mesh(24), 1.6 * on_mesh(10));
}

TEST(Multigrid, EqualsTheDirectSolve) {
  const TetMesh mesh = perturbed_box({{0, 0, 0}, {1, 1, 2}}, {7, 7, 7}, 0.2);  // beyond one level
  const MeshSpace space(mesh);
  const GridSpace grid({{8, 8, 8}, {1, 1, 2}});
  for (const P1Space* s :
       {static_cast<const P1Space*>(&space), static_cast<const P1Space*>(&grid)}) {
    const auto a = stiff(*s, 100);
    const std::vector<double> b = wave(a->size(), 3);
    std::vector<double> x(b.size(), 0);
    EXPECT_TRUE(solve_by_multigrid(*a, b, x, 1e-13).converged);
    const std::vector<double> expected = solve_dense(dense(*a), b);
    const double scale = std::sqrt(inner(expected, expected));
    for (std::size_t i = 0; i < x.size(); ++i) EXPECT_NEAR(x[i] / scale, expected[i] / scale, 1e-9);
  }
}

TEST(Multigrid, IsSymmetricAndPositiveDefinite) {
  const GridSpace space({{11, 10, 9}, {1, 0.5, 2}});
  const auto a = stiff(space, 1000);
  const Multigrid multigrid(*a);
  const std::size_t n = a->size();
  std::vector<double> bx(n), by(n);
  for (const double frequency : {0.01, 0.3, 1.7, 3.1}) {
    const std::vector<double> x = wave(n, frequency), y = wave(n, 2.3 * frequency + 0.1);
    multigrid.apply(x, bx);
    multigrid.apply(y, by);
    EXPECT_NEAR(inner(bx, y) / inner(x, by), 1, 1e-9);
    EXPECT_GT(inner(bx, x), 0);
  }
}

TEST(Multigrid, IsLinear) {
  const GridSpace space({{11, 10, 9}, {1, 1, 1}});
  const auto a = stiff(space, 1000);
  const Multigrid multigrid(*a);
  const std::vector<double> x = wave(a->size(), 0.3), y = wave(a->size(), 1.1);
  std::vector<double> sum(x), bx(x.size()), by(x.size()), b_sum(x.size());
  for (std::size_t i = 0; i < sum.size(); ++i) sum[i] = 2 * x[i] - 3 * y[i];
  multigrid.apply(x, bx), multigrid.apply(y, by), multigrid.apply(sum, b_sum);
  const double scale = std::sqrt(inner(b_sum, b_sum));
  for (std::size_t i = 0; i < sum.size(); ++i) {
    EXPECT_NEAR(b_sum[i] / scale, (2 * bx[i] - 3 * by[i]) / scale, 1e-12);
  }
}

TEST(Multigrid, SolvesUncoupledUnknownsWithoutCoarsening) {
  std::vector<Triplet> triplets;
  for (Index i = 0; i < 1000; ++i) triplets.push_back({i, i, 1.0 + i});
  const MatrixOperator a(from_triplets(1000, std::move(triplets)));
  std::vector<double> b(1000, 1), x(1000, 0);
  EXPECT_TRUE(solve_by_multigrid(a, b, x, 1e-12).converged);
  for (std::size_t i = 0; i < 1000; ++i) EXPECT_NEAR(x[i] * (1.0 + double(i)), 1, 1e-9);
}

TEST(Multigrid, TheSameBitsForAnyNumberOfThreads) {
  const GridSpace space({{33, 30, 20}, {1, 1, 1}});
  const auto a = stiff(space, 1000);
  const std::vector<double> r = wave(a->size(), 0.7);
  const auto apply = [&] {
    std::vector<double> z(r.size());
    Multigrid(*a).apply(r, z);
    return z;
  };
  EXPECT_EQ(with_threads(1, apply), with_threads(3, apply));
}

}  // namespace
}  // namespace mesamis
