// SPDX-License-Identifier: Apache-2.0
#include "mesamis/fem/single_grid_system.h"

#include <gtest/gtest.h>

#include <cmath>

#include "mesamis/base/parallel.h"
#include "mesamis/fem/grid_space.h"
#include "mesamis/fem/solve.h"

namespace mesamis {
namespace {

/// Odd and even numbers of layers, and an axis with no inner node.
const std::array<KuhnGrid, 3> kGrids{
    {{{5, 4, 6}, {1, 0.6, 1.7}}, {{17, 6, 7}, {1, 1, 1}}, {{2, 3, 2}, {0.5, 1, 2}}}};

std::vector<float> wave(const KuhnGrid& grid, double frequency) {
  std::vector<float> values;
  for (std::size_t n = 0; n < grid.node_count(); ++n) {
    values.push_back(static_cast<float>(1.5 + std::sin(frequency * static_cast<double>(n))));
  }
  return values;
}

std::vector<double> exactly(const std::vector<float>& x) { return {x.begin(), x.end()}; }

double largest(const std::vector<double>& x) {
  double most = 0;
  for (const double value : x) most = std::max(most, std::abs(value));
  return most;
}

void expect_near(const std::vector<float>& found, const std::vector<double>& expected,
                 double share) {
  ASSERT_EQ(found.size(), expected.size());
  const double tolerance = share * largest(expected);
  for (std::size_t n = 0; n < found.size(); ++n) EXPECT_NEAR(found[n], expected[n], tolerance);
}

TEST(GridMass, IsTheLumpedMassOfEveryNode) {
  for (const KuhnGrid& grid : kGrids) {
    const GridSpace space(grid);
    const GridMass mass(grid);
    std::size_t n = 0;
    for (Index k = 0; k < grid.size[2]; ++k) {
      for (Index j = 0; j < grid.size[1]; ++j) {
        for (Index i = 0; i < grid.size[0]; ++i, ++n) {
          EXPECT_NEAR(mass.at(n) / space.lumped_mass()[n], 1, 1e-14);
          EXPECT_EQ(mass.row(j, k).at(i), mass.at(n));
        }
      }
    }
  }
}

TEST(SingleGrid, GradientSquaresAreThoseOfTheSpace) {
  for (const KuhnGrid& grid : kGrids) {
    const std::vector<float> u = wave(grid, 2);
    std::vector<float> squares(u.size(), 99);
    find_gradient_squares(grid, u, squares);
    expect_near(squares, GridSpace(grid).gradient_squares(exactly(u)), 1e-6);
  }
}

TEST(SingleGrid, SumsOverNodesSeeEachOnceWithItsMass) {
  for (const KuhnGrid& grid : kGrids) {
    const Vec3 sides = grid.box().extent();
    const auto mass = [](std::size_t, double m) { return m; };
    const auto number = [](std::size_t n, double) { return static_cast<double>(n); };
    const auto count = static_cast<double>(grid.node_count());
    EXPECT_NEAR(sum_over_nodes(grid, GridMass(grid), mass) / (sides.x * sides.y * sides.z), 1,
                1e-12);
    EXPECT_EQ(sum_over_nodes(grid, GridMass(grid), number), count * (count - 1) / 2);
  }
}

TEST(SingleGrid, SolvesTheSystemOfTheSpace) {
  for (const KuhnGrid& grid : kGrids) {
    for (const auto& v : {wave(grid, 3), std::vector<float>{}}) {
      std::vector<double> w;
      for (const float x : v) w.push_back(double{x} * double{x});
      const std::vector<float> d = wave(grid, 5), b = wave(grid, 7);
      const auto exact = GridSpace(grid).diffusion(w, 1.3, 0.2, exactly(d));
      std::vector<double> expected(b.size(), 0);
      solve(*exact, exactly(b), expected, {.tolerance = 1e-12});

      SingleGridSystem system(grid);
      system.diagonal() = d;
      system.right() = b;
      system.couple(v, 1.3, 0.2);
      std::vector<float> x = wave(grid, 1);
      const SolveReport report = system.solve(x, {.tolerance = 1e-6});
      EXPECT_TRUE(report.converged);
      EXPECT_GT(report.iterations, 0);
      expect_near(x, expected, 1e-5);
    }
  }
}

TEST(SingleGrid, SaysWhereTheIterationsDoNotSuffice) {
  const KuhnGrid grid{{20, 20, 20}, {1, 1, 1}};
  SingleGridSystem system(grid);
  system.diagonal().assign(grid.node_count(), 1e-3F);
  system.right() = wave(grid, 2);
  system.couple({}, 0, 100);
  std::vector<float> x(grid.node_count(), 0);
  const SolveReport report = system.solve(x, {.tolerance = 1e-5, .jacobi_iterations = 3});
  EXPECT_EQ(report.iterations, 3);
  EXPECT_FALSE(report.converged);
}

TEST(SingleGrid, AConstantStaysWhatItIsToTheBit) {
  const KuhnGrid& grid = kGrids[1];
  SingleGridSystem system(grid);
  system.diagonal() = wave(grid, 5);
  system.right() = system.diagonal();
  for (float& b : system.right()) b *= 0.7F;
  system.couple(wave(grid, 3), 1.3, 0.2);
  std::vector<float> x(grid.node_count(), 0.7F);
  EXPECT_EQ(system.solve(x, {}).iterations, 0);
  for (const float value : x) EXPECT_EQ(value, 0.7F);
}

TEST(SingleGrid, ZeroIsTheSolutionOfZero) {
  const KuhnGrid& grid = kGrids[0];
  SingleGridSystem system(grid);
  system.diagonal().assign(grid.node_count(), 1);
  system.couple({}, 0, 1);
  std::vector<float> x = wave(grid, 1);
  EXPECT_TRUE(system.solve(x, {}).converged);
  for (const float value : x) EXPECT_EQ(value, 0);
}

TEST(SingleGrid, TheSameBitsForAnyNumberOfThreads) {
  const KuhnGrid grid{{33, 31, 29}, {1, 1, 1}};
  const auto solved = [&](int threads) {
    return with_threads(threads, [&] {
      SingleGridSystem system(grid);
      find_gradient_squares(grid, wave(grid, 0.1), system.diagonal());
      for (float& d : system.diagonal()) d += 1;
      system.right() = wave(grid, 2);
      system.couple(wave(grid, 3), 1, 0.1);
      std::vector<float> x(grid.node_count(), 0);
      system.solve(x, {});
      return x;
    });
  };
  EXPECT_EQ(solved(1), solved(4));
}

}  // namespace
}  // namespace mesamis
