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
  std::vector<double> u, v, f;
};

Fields random_fields(std::size_t nodes) {
  std::mt19937 generator(11);
  std::uniform_real_distribution<double> uniform(0, 1);
  Fields fields;
  for (std::size_t n = 0; n < nodes; ++n) {
    fields.u.push_back(255 * uniform(generator));
    fields.v.push_back(uniform(generator));
    fields.f.push_back(255 * uniform(generator));
  }
  return fields;
}

TEST(GridEstimator, AgreesWithTheMeshOfItsCells) {
  // More layers than one slab, odd sizes, anisotropic spacing: nothing may depend on the tiling.
  const KuhnGrid grid{{6, 5, 12}, {1, 0.7, 1.6}};
  const TetMesh mesh = box_mesh(grid.box(), {5, 4, 11});
  const Fields x = random_fields(grid.node_count());
  const AtParameters parameters{0.3, 0.01, 1.5, 4};
  const double tau = 0.01, stretch = 3e4;
  const Estimate expected = estimate(mesh, parameters, {x.u, x.v, x.f});
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
  const std::vector<double> right(27, 1), wrong(26, 1);
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

}  // namespace
}  // namespace mesamis
