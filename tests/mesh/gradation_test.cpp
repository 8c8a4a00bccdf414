// SPDX-License-Identifier: Apache-2.0
#include "mesamis/mesh/gradation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "mesamis/base/parallel.h"
#include "mesamis/base/sym3.h"
#include "mesamis/mesh/edges.h"
#include "mesamis/mesh/metric.h"
#include "support/perturbed_box.h"
#include "support/throws.h"

namespace mesamis {
namespace {

using ::testing::HasSubstr;

const Box kBar{{0, 0, 0}, {4, 0.2, 0.2}};

Sym3 of_sizes(double hx, double hy, double hz) {
  return {1 / (hx * hx), 0, 0, 1 / (hy * hy), 0, 1 / (hz * hz)};
}

/// Fine at x = 0, as coarse as `far` elsewhere.
std::vector<Sym3> fine_at_one_end(const TetMesh& bar, const Sym3& fine, const Sym3& far) {
  std::vector<Sym3> metrics;
  for (const Vec3& p : bar.points) metrics.push_back(p.x == 0 ? fine : far);
  return metrics;
}

TEST(Gradation, SizesGrowLinearlyFromAFineEnd) {
  const TetMesh bar = box_mesh(kBar, {40, 2, 2});
  for (const double gradation : {1.2, 1.5, 3.0}) {
    auto metrics = fine_at_one_end(bar, of_sizes(0.05, 0.05, 0.05), of_sizes(1, 1, 1));
    EXPECT_GT(limit_gradation(bar, metrics, gradation), 0);
    for (std::size_t n = 0; n < metrics.size(); ++n) {
      const double h = std::min(1.0, 0.05 + bar.points[n].x * std::log(gradation));
      EXPECT_NEAR(1 / std::sqrt(metrics[n].xx), h, 2e-3 * h);
      EXPECT_NEAR(1 / std::sqrt(metrics[n].yy), h, 2e-3 * h);
    }
  }
}

TEST(Gradation, AspectIsKeptUntilTheCoarserMetricIsMet) {
  const TetMesh bar = box_mesh(kBar, {40, 2, 2});
  auto metrics = fine_at_one_end(bar, of_sizes(0.02, 0.2, 0.4), of_sizes(5, 5, 5));
  limit_gradation(bar, metrics, 1.5);
  for (std::size_t n = 0; n < metrics.size(); ++n) {
    const double factor = 1 + bar.points[n].x * std::log(1.5) / 0.02;
    EXPECT_NEAR(1 / std::sqrt(metrics[n].xx), std::min(5.0, 0.02 * factor), 0.01 * factor * 0.02);
    EXPECT_NEAR(1 / std::sqrt(metrics[n].yy), std::min(5.0, 0.2 * factor), 0.01 * factor * 0.2);
    EXPECT_NEAR(1 / std::sqrt(metrics[n].zz), std::min(5.0, 0.4 * factor), 0.01 * factor * 0.4);
  }
}

std::vector<Sym3> random_metrics(std::size_t count) {
  std::mt19937 generator(3);
  std::uniform_real_distribution<double> uniform(-1, 1);
  std::vector<Sym3> metrics;
  for (std::size_t n = 0; n < count; ++n) {
    std::array<double, 6> e{};
    for (double& value : e) value = 3 * uniform(generator);
    metrics.push_back(exp_sym({e[0], e[1], e[2], e[3], e[4], e[5]}));
  }
  return metrics;
}

/// Whether m is nowhere coarser than `other` by more than 0.2 % of a squared size.
void expect_covers(const Sym3& m, const Sym3& other) {
  for (const double value : eigen_decompose(1.0021 * m - other).values) {
    EXPECT_GT(value, -1e-9 * trace(m));
  }
}

TEST(Gradation, NothingGetsCoarserAndAllNeighborsAllowWhatIsLeft) {
  const TetMesh mesh = perturbed_box({{0, 0, 0}, {1, 1, 1}}, {6, 6, 6}, 0.2);
  const auto before = random_metrics(mesh.points.size());
  auto metrics = before;
  EXPECT_GT(limit_gradation(mesh, metrics, 1.5), 50);
  for (std::size_t n = 0; n < before.size(); ++n) expect_covers(metrics[n], before[n]);
  for (const auto& [a, b] : unique_edges(mesh)) {
    const Vec3 e = mesh.points[b] - mesh.points[a];
    for (const auto& [from, to] : {Edge{a, b}, Edge{b, a}}) {
      const double growth = 1 + std::sqrt(quadratic_form(metrics[from], e)) * std::log(1.5);
      expect_covers(metrics[to], 1 / (growth * growth) * metrics[from]);
    }
  }
  EXPECT_EQ(limit_gradation(mesh, metrics, 1.5), 0);
}

TEST(Gradation, SameBitsForAnyNumberOfThreads) {
  const TetMesh mesh = perturbed_box({{0, 0, 0}, {1, 1, 1}}, {16, 16, 16}, 0.2);
  auto one = random_metrics(mesh.points.size()), four = one;
  with_threads(1, [&] { limit_gradation(mesh, one, 1.3); });
  with_threads(4, [&] { limit_gradation(mesh, four, 1.3); });
  EXPECT_EQ(one, four);
}

TEST(Gradation, RefusesWhatMakesNoSense) {
  const TetMesh mesh = box_mesh(kBar, {1, 1, 1});
  std::vector<Sym3> metrics(8, kIdentity3);
  EXPECT_REFUSED(limit_gradation(mesh, metrics, 1.0), HasSubstr("more than 1"));
  EXPECT_REFUSED(limit_gradation(mesh, metrics, NAN), HasSubstr("more than 1"));
  for (const Sym3& bad : {Sym3{}, -1 * kIdentity3, Sym3{1, 2, 0, 1, 0, 1}, NAN * kIdentity3}) {
    metrics[5] = bad;
    EXPECT_REFUSED(limit_gradation(mesh, metrics, 1.5), HasSubstr("node 5"));
  }
  metrics.pop_back();
  EXPECT_REFUSED(limit_gradation(mesh, metrics, 1.5), HasSubstr("7 metrics for 8 nodes"));
}

}  // namespace
}  // namespace mesamis
