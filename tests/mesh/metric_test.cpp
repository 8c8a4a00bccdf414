// SPDX-License-Identifier: Apache-2.0
#include "mesamis/mesh/metric.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "mesamis/base/error.h"
#include "mesamis/base/sym3.h"
#include "mesamis/mesh/edges.h"
#include "support/perturbed_box.h"

namespace mesamis {
namespace {

const Box kBox{{0, 0, 0}, {2, 3, 4}};

Sym3 of_size(double h) { return (1 / (h * h)) * kIdentity3; }

/// Sizes between 1 and `ratio` in random directions.
Sym3 random_metric(std::mt19937& generator, double ratio) {
  std::uniform_real_distribution<double> uniform(-1, 1);
  Sym3 direction;
  for (double* entry :
       {&direction.xx, &direction.xy, &direction.xz, &direction.yy, &direction.yz, &direction.zz}) {
    *entry = uniform(generator);
  }
  SymEigen e = eigen_decompose(direction);
  for (double& value : e.values) value = std::pow(ratio, -1 - uniform(generator));
  return compose(e.values, e.vectors);
}

TEST(MetricLength, OfAConstantMetricIsTheNorm) {
  std::mt19937 generator(1);
  for (int i = 0; i < 100; ++i) {
    const Sym3 m = random_metric(generator, 1000);
    const Vec3 e{0.3, -2, 1.5};
    const double norm = std::sqrt(quadratic_form(m, e));
    EXPECT_NEAR(metric_length(m, m, e), norm, 1e-12 * norm);
  }
}

TEST(MetricLength, IntegratesSizesThatGrowGeometrically) {
  for (const double ratio : {1.0005, 1.002, 1.1, 3.0, 1000.0}) {
    const double ha = 0.7, hb = ha * ratio;
    double integral = 0;  // of |e| / h(t), midpoint rule
    constexpr int kSteps = 100'000;
    for (int i = 0; i < kSteps; ++i) {
      integral += 5 / (ha * std::pow(ratio, (i + 0.5) / kSteps)) / kSteps;
    }
    EXPECT_NEAR(metric_length(of_size(ha), of_size(hb), {3, 0, 4}), integral, 1e-6 * integral);
    EXPECT_NEAR(metric_length(of_size(hb), of_size(ha), {3, 0, 4}), integral, 1e-6 * integral);
  }
}

double largest_entry(const Sym3& m) {
  return std::max({std::abs(m.xx), std::abs(m.xy), std::abs(m.xz), std::abs(m.yy), std::abs(m.yz),
                   std::abs(m.zz)});
}

TEST(Intersect, OfMetricsWithCommonAxesTakesTheSmallerSizes) {
  std::mt19937 generator(5);
  for (int i = 0; i < 100; ++i) {
    const SymEigen e = eigen_decompose(random_metric(generator, 10));
    const Sym3 a = compose({4, 100, 0.01}, e.vectors), b = compose({9, 1, 0.01}, e.vectors);
    EXPECT_LT(largest_entry(intersect(a, b) - compose({9, 100, 0.01}, e.vectors)), 1e-10);
    EXPECT_LT(largest_entry(intersect(a, 0.5 * a) - a), 1e-10);
  }
}

TEST(Intersect, IsNowhereCoarserThanEitherAndTouchesOneOfThem) {
  std::mt19937 generator(6);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 200; ++i) {
    const Sym3 a = random_metric(generator, 100), b = random_metric(generator, 100);
    const Sym3 both = intersect(a, b);
    EXPECT_LT(largest_entry(both - intersect(b, a)), 1e-8 * largest_entry(both));
    for (int k = 0; k < 20; ++k) {
      const Vec3 v{normal(generator), normal(generator), normal(generator)};
      const double needed = std::max(quadratic_form(a, v), quadratic_form(b, v));
      EXPECT_GE(quadratic_form(both, v), needed * (1 - 1e-9));
    }
    // No finer than needed: along each common axis it touches a or b, so one difference is
    // singular.
    const double scale = std::pow(largest_entry(both), 3);
    const double to_a = std::abs(determinant(both - a)), to_b = std::abs(determinant(both - b));
    EXPECT_LT(std::min(to_a, to_b), 1e-9 * scale);
  }
}

const std::array<Vec3, 4> kRegular{Vec3{1, 1, 1}, Vec3{1, -1, -1}, Vec3{-1, 1, -1},
                                   Vec3{-1, -1, 1}};

TEST(MetricQuality, IsOneForTheIdealCellAndZeroForAFlatOne) {
  std::array<Vec3, 4> cell = kRegular;
  if (six_volume(cell[0], cell[1], cell[2], cell[3]) < 0) std::swap(cell[0], cell[1]);
  EXPECT_NEAR(metric_quality(kIdentity3, cell), 1, 1e-14);
  EXPECT_NEAR(metric_quality(of_size(1e-3), cell), 1, 1e-14);
  std::swap(cell[0], cell[1]);
  EXPECT_EQ(metric_quality(kIdentity3, cell), 0);
  cell[3] = 0.5 * (cell[0] + cell[1]);
  EXPECT_EQ(metric_quality(kIdentity3, cell), 0);
}

TEST(MetricQuality, OfAStretchedCellIsThatOfTheCellBeforeStretching) {
  std::mt19937 generator(2);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (int i = 0; i < 1000; ++i) {
    std::array<Vec3, 4> cell;
    for (Vec3& p : cell) p = {uniform(generator), uniform(generator), uniform(generator)};
    const double quality = metric_quality(kIdentity3, cell);
    const Sym3 m = random_metric(generator, 100);
    const Sym3 stretch = exp_sym(-0.5 * log_spd(m));
    std::array<Vec3, 4> stretched;
    for (std::size_t n = 0; n < 4; ++n) stretched[n] = stretch * cell[n];
    EXPECT_NEAR(metric_quality(m, stretched), quality, 1e-7);
    EXPECT_GE(quality, 0);
    EXPECT_LE(quality, 1);
  }
}

TEST(LogEuclideanMean, OfDeterminantsIsTheGeometricMean) {
  std::mt19937 generator(3);
  for (int i = 0; i < 100; ++i) {
    const std::array<Sym3, 3> m{random_metric(generator, 100), random_metric(generator, 100),
                                random_metric(generator, 100)};
    const std::array<double, 3> weights{0.2, 0.5, 0.3};
    double log = 0;
    for (std::size_t k = 0; k < 3; ++k) log += weights[k] * std::log(determinant(m[k]));
    const double det = determinant(log_euclidean_mean(m, weights));
    EXPECT_NEAR(std::log(det), log, 1e-6);
  }
  const std::array<Sym3, 2> sizes{of_size(1), of_size(16)};
  EXPECT_NEAR(log_euclidean_mean(sizes, std::array<double, 2>{0.5, 0.5}).yy, 1.0 / 16, 1e-14);
}

TEST(ClampSizes, BringsEverySizeWithinBounds) {
  std::mt19937 generator(4);
  for (int i = 0; i < 100; ++i) {
    const Sym3 m = random_metric(generator, 1000);
    for (const double value : eigen_decompose(clamp_sizes(m, 2, 50)).values) {
      EXPECT_GE(1 / std::sqrt(value), 2 * (1 - 1e-9));
      EXPECT_LE(1 / std::sqrt(value), 50 * (1 + 1e-9));
    }
  }
  EXPECT_NEAR(clamp_sizes({}, 1, 10).zz, 0.01, 1e-15);
  EXPECT_NEAR(clamp_sizes({4, 0, 0, 0, 0, 0}, 0.1, 10).xx, 4, 1e-12);
}

TEST(Complexity, IsExactForALinearRootOfTheDeterminant) {
  const TetMesh mesh = perturbed_box(kBox, {3, 3, 3}, 0.2);
  std::vector<Sym3> metrics;
  for (const Vec3& p : mesh.points) {
    const double root = 1 + 2 * p.x + 0.5 * p.z;
    metrics.push_back(std::pow(root, 2.0 / 3) * kIdentity3);
  }
  EXPECT_NEAR(complexity(mesh, metrics), kBox.volume() * (1 + 2 * 1 + 0.5 * 2), 1e-11);
  metrics.pop_back();
  EXPECT_THROW(complexity(mesh, metrics), InputError);
}

TEST(MeasureFit, NamesTheWorstCellAndTheEdgesOfExtremeLength) {
  const TetMesh mesh = perturbed_box(kBox, {4, 3, 5}, 0.2);
  std::mt19937 generator(5);
  std::vector<Sym3> metrics;
  for (std::size_t n = 0; n < mesh.points.size(); ++n)
    metrics.push_back(random_metric(generator, 3));
  const MeshFit fit = measure_fit(mesh, metrics);
  auto length_of = [&](const Edge& e) {
    return metric_length(metrics[e[0]], metrics[e[1]], mesh.points[e[1]] - mesh.points[e[0]]);
  };
  EXPECT_EQ(length_of(fit.shortest), fit.length_min);
  EXPECT_EQ(length_of(fit.longest), fit.length_max);
  for (const Edge& e : unique_edges(mesh)) {
    EXPECT_GE(length_of(e), fit.length_min);
    EXPECT_LE(length_of(e), fit.length_max);
  }
  const Cell& worst = mesh.cells[fit.worst_cell];
  double quality = 0;  // in the metric of largest determinant
  double largest = 0;
  for (const Index n : worst) {
    if (determinant(metrics[n]) <= largest) continue;
    largest = determinant(metrics[n]);
    quality = metric_quality(metrics[n], cell_corners(mesh, worst));
  }
  EXPECT_EQ(quality, fit.quality_min);
}

TEST(MeasureFit, OfTheUnitKuhnBox) {
  // Edges 1, sqrt 2 (both unit) and sqrt 3, one of the last per brick; all cells are alike.
  const TetMesh mesh = box_mesh(kBox, {2, 3, 4});
  const std::vector<Sym3> metrics(mesh.points.size(), kIdentity3);
  const MeshFit fit = measure_fit(mesh, metrics);
  const auto edges = static_cast<double>(unique_edges(mesh).size());
  EXPECT_EQ(static_cast<double>(fit.edges), edges);
  EXPECT_NEAR(fit.unit_edge_fraction, 1 - 24 / edges, 1e-12);
  EXPECT_NEAR(fit.length_min, 1, 1e-12);
  EXPECT_NEAR(fit.length_max, std::sqrt(3.0), 1e-12);
  EXPECT_NEAR(fit.quality_min, fit.quality_mean, 1e-12);
  EXPECT_NEAR(fit.quality_min, 6 * std::cbrt(2.0) / 10, 1e-12);
}

}  // namespace
}  // namespace mesamis
