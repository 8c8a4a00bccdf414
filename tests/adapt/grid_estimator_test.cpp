// SPDX-License-Identifier: Apache-2.0
#include "mesamis/adapt/grid_estimator.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "mesamis/adapt/metric_from_estimate.h"
#include "mesamis/base/error.h"
#include "mesamis/base/parallel.h"

namespace mesamis {
namespace {

struct Fields {
  std::vector<float> u, v, f;
};

std::vector<double> exactly(const std::vector<float>& x) { return {x.begin(), x.end()}; }

Fields random_fields(std::size_t nodes) {
  std::mt19937 generator(11);
  std::uniform_real_distribution<float> uniform(0, 1);
  Fields fields;
  for (std::size_t n = 0; n < nodes; ++n) {
    fields.u.push_back(255 * uniform(generator));
    fields.v.push_back(uniform(generator));
    fields.f.push_back(255 * uniform(generator));
  }
  return fields;
}

TEST(GridEstimator, AgreesWithTheMeshOfItsCells) {
  // More than one slab and strip, odd sizes, anisotropic spacing: nothing may depend on the tiling.
  const KuhnGrid grid{{6, 36, 12}, {1, 0.7, 1.6}};
  const TetMesh mesh = box_mesh(grid.box(), {5, 35, 11});
  const Fields x = random_fields(grid.node_count());
  const AtParameters parameters{0.3, 0.01, 1.5, 4};
  const double tau = 0.01, stretch = 3e4;
  const std::vector<double> u = exactly(x.u), v = exactly(x.v), f = exactly(x.f);
  const Estimate expected = estimate(mesh, parameters, {u, v, f});
  std::vector<Sym3> cell_metrics;
  for (const Sym3& gamma : expected.gamma) {
    cell_metrics.push_back(cell_metric(gamma, {grid.cell_count(), tau, stretch}));
  }
  const auto nodes = node_metrics(mesh, cell_metrics);

  const GridEstimate found =
      estimate_on_grid(grid, parameters, {x.u, x.v, x.f}, {.tau = tau, .max_stretch = stretch});
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_NEAR(found.sums.residuals.a[i] / expected.sums.residuals.a[i], 1, 1e-9);
  }
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(found.sums.residuals.b[i] / expected.sums.residuals.b[i], 1, 1e-9);
  }
  EXPECT_NEAR(found.sums.zeta_a / expected.sums.zeta_a, 1, 1e-9);
  EXPECT_NEAR(found.sums.zeta_b / expected.sums.zeta_b, 1, 1e-9);
  EXPECT_NEAR(found.predicted_cells / predicted_cells(mesh, cell_metrics), 1, 1e-9);
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    const Sym3 difference = unpack(found.node_metrics[n]) - nodes[n];
    EXPECT_LT(std::abs(difference.xx) + std::abs(difference.xy) + std::abs(difference.zz),
              1e-5 * trace(nodes[n]));
  }
}

TEST(GridEstimator, WhereTheFieldsAreFlatNothingIsAskedFor) {
  // A peak: the metric is that of the mesh near it, and zero beyond.
  const KuhnGrid grid{{12, 11, 20}, {1, 1, 1}};
  const TetMesh mesh = box_mesh(grid.box(), {11, 10, 19});
  const std::size_t count = grid.node_count(), middle = count / 2 + 6;
  std::vector<float> u(count, 40), v(count, 1);
  u[middle] = 50, v[middle] = 0.5F;
  const std::vector<double> exact_u = exactly(u), exact_v = exactly(v);
  const Estimate expected = estimate(mesh, {}, {exact_u, exact_v, exact_u});
  std::vector<Sym3> cells;
  for (const Sym3& gamma : expected.gamma) {
    cells.push_back(cell_metric(gamma, {.cell_count = grid.cell_count()}));
  }
  const auto nodes = node_metrics(mesh, cells);
  const GridEstimate found = estimate_on_grid(grid, {}, {u, v, u}, {});
  EXPECT_NEAR(found.sums.zeta() / expected.sums.zeta(), 1, 1e-9);
  EXPECT_NEAR(found.sums.residuals.b[0] / expected.sums.residuals.b[0], 1, 1e-9);
  std::size_t zeros = 0;
  for (std::size_t n = 0; n < count; ++n) {
    EXPECT_NEAR(found.node_metrics[n][0], nodes[n].xx, 1e-5 * trace(nodes[n]));
    zeros += found.node_metrics[n][0] == 0;
  }
  EXPECT_GT(zeros, count / 2);
}

TEST(GridEstimator, TheSameBitsForAnyNumberOfThreads) {
  const KuhnGrid grid{{7, 6, 41}, {1, 1, 1}};
  const Fields x = random_fields(grid.node_count());
  const GridEstimate a = with_threads(1, [&] {
    return estimate_on_grid(grid, {}, {x.u, x.v, x.f}, {});
  });
  const GridEstimate b = with_threads(4, [&] {
    return estimate_on_grid(grid, {}, {x.u, x.v, x.f}, {});
  });
  EXPECT_EQ(a.node_metrics, b.node_metrics);
  EXPECT_EQ(a.sums.zeta_a, b.sums.zeta_a);
}

TEST(GridEstimator, RefusesFieldsOfAnotherSize) {
  const KuhnGrid grid{{3, 3, 3}, {1, 1, 1}};
  const std::vector<float> right(27, 1), wrong(26, 1);
  EXPECT_THROW(estimate_on_grid(grid, {}, {wrong, right, right}, {}), InputError);
}

TEST(SmoothLogMetrics, KeepsAConstantAndSpreadsAPeak) {
  const KuhnGrid grid{{5, 5, 5}, {1, 1, 1}};
  std::vector<PackedSym3> logs(125, PackedSym3{1, 2, 3, 4, 5, 6});
  const auto constant = logs;
  smooth_log_metrics(grid, logs, 3);
  for (std::size_t n = 0; n < 125; ++n) {
    for (std::size_t c = 0; c < 6; ++c) EXPECT_NEAR(logs[n][c], constant[n][c], 1e-5);
  }
  std::vector<PackedSym3> peak(125, PackedSym3{});
  peak[62][0] = 8;  // the middle
  smooth_log_metrics(grid, peak, 1);
  EXPECT_FLOAT_EQ(peak[62][0], 2);
  EXPECT_FLOAT_EQ(peak[61][0], 1);
  EXPECT_FLOAT_EQ(peak[62 + 25][0], 1);
  EXPECT_FLOAT_EQ(peak[60][0], 0);
}

TEST(SmoothLogMetrics, AddsUpNeighboursThroughAllLayers) {
  const KuhnGrid grid{{4, 3, 37}, {1, 1, 1}};
  std::mt19937 generator(2);
  std::uniform_real_distribution<float> uniform(-1, 1);
  std::vector<PackedSym3> before(grid.node_count());
  for (PackedSym3& log : before) {
    for (float& entry : log) entry = uniform(generator);
  }
  std::vector<PackedSym3> logs = before;
  smooth_log_metrics(grid, logs, 1);
  const auto stride = grid.stride();
  for (std::size_t n = 0; n < logs.size(); ++n) {
    double sum = 2 * before[n][4], weights = 2;
    for (std::size_t a = 0; a < 3; ++a) {
      const auto at = static_cast<Index>(n / stride[a] % static_cast<std::size_t>(grid.size[a]));
      if (at > 0) sum += before[n - stride[a]][4], ++weights;
      if (at + 1 < grid.size[a]) sum += before[n + stride[a]][4], ++weights;
    }
    EXPECT_NEAR(logs[n][4], sum / weights, 1e-6);
  }
}

TEST(SmoothLogMetrics, TheSameBitsForAnyNumberOfThreads) {
  const KuhnGrid grid{{7, 6, 50}, {1, 1, 1}};
  const auto smoothed = [&](int threads) {
    return with_threads(threads, [&] {
      std::vector<PackedSym3> logs(grid.node_count());
      for (std::size_t n = 0; n < logs.size(); ++n) {
        logs[n][0] = std::sin(static_cast<float>(n));
      }
      smooth_log_metrics(grid, logs, 3);
      return logs;
    });
  };
  EXPECT_EQ(smoothed(1), smoothed(4));
}

}  // namespace
}  // namespace mesamis
