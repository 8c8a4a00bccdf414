// SPDX-License-Identifier: Apache-2.0
#include "mesamis/adapt/size_control.h"

#include <gtest/gtest.h>

#include <random>

#include "mesamis/base/error.h"
#include "mesamis/mesh/metric.h"

namespace mesamis {
namespace {

std::vector<Sym3> random_metrics(std::size_t count) {
  std::mt19937 generator(5);
  std::uniform_real_distribution<double> uniform(-3, 3);
  std::vector<Sym3> metrics(count);
  for (Sym3& m : metrics) {
    m = exp_sym({uniform(generator), uniform(generator), uniform(generator), uniform(generator),
                 uniform(generator), uniform(generator)});
  }
  return metrics;
}

double complexity_of(const std::vector<Sym3>& metrics, const std::vector<double>& weights) {
  double sum = 0;
  for (std::size_t n = 0; n < metrics.size(); ++n) {
    sum += weights[n] * std::sqrt(determinant(metrics[n]));
  }
  return sum;
}

TEST(SizeControl, MeetsTheBoundAfterClamping) {
  auto metrics = random_metrics(500);
  const std::vector<double> weights(500, 0.1);
  const double bound = complexity_of(metrics, weights) / 10;
  const double factor = control_sizes(metrics, weights, {0.05, 3, bound});
  EXPECT_GT(factor, 1);
  EXPECT_NEAR(complexity_of(metrics, weights) / bound, 1, 1e-5);
  for (const Sym3& m : metrics) {
    const SymEigen e = eigen_decompose(m);
    EXPECT_LE(e.values[0], 1 / (0.05 * 0.05) * (1 + 1e-9));
    EXPECT_GE(e.values[2], 1 / 9.0 * (1 - 1e-9));
  }
}

TEST(SizeControl, ScalesAloneAsTwoThirdsPowerWithoutClamps) {
  // Equation (12): without clamps M scales by (bound / complexity)^(2/3).
  auto metrics = random_metrics(50);
  const auto before = metrics;
  const std::vector<double> weights(50, 0.3);
  const double factor =
      control_sizes(metrics, weights, {1e-9, 1e9, complexity_of(metrics, weights) / 27});
  EXPECT_NEAR(factor, 3, 1e-6);
  EXPECT_NEAR(metrics[7].xy, before[7].xy / 9, 1e-5 * std::abs(before[7].xx));
}

TEST(SizeControl, NeverRefines) {
  auto metrics = random_metrics(50);
  const auto before = metrics;
  const std::vector<double> weights(50, 0.3);
  EXPECT_EQ(control_sizes(metrics, weights, {1e-9, 1e9, 1e12}), 1);
  for (std::size_t n = 0; n < 50; ++n)
    EXPECT_NEAR(metrics[n].xx, before[n].xx, 1e-9 * trace(before[n]));
}

TEST(SizeControl, AZeroMetricGetsTheLargestSize) {
  std::vector<Sym3> metrics(3);
  const std::vector<double> weights(3, 1);
  control_sizes(metrics, weights, {0.1, 4, 0});
  for (const Sym3& m : metrics) EXPECT_EQ(m, (1.0 / 16) * kIdentity3);
}

TEST(SizeControl, LogarithmsAreThoseOfTheMetric) {
  auto metrics = random_metrics(60);
  std::vector<PackedSym3> packed;
  for (const Sym3& m : metrics) packed.push_back(pack(m));
  const KuhnGrid grid{{3, 4, 5}, {1, 1, 1}};
  const SizeControl control{0.2, 5, 5};
  const double a = control_sizes(metrics, GridSpace(grid).lumped_mass(), control);
  EXPECT_GT(a, 1);
  const double b = control_sizes_to_log(grid, packed, control);
  EXPECT_NEAR(a, b, 1e-5);
  for (std::size_t n = 0; n < 60; ++n) {
    EXPECT_NEAR(trace(exp_sym(unpack(packed[n]))) / trace(metrics[n]), 1, 1e-4);
  }
}

TEST(SizeControl, SetComplexityScalesAllSizesAlike) {
  auto metrics = random_metrics(40);
  const KuhnGrid grid{{2, 4, 5}, {1, 0.5, 2}};
  const std::vector<double> weights = GridSpace(grid).lumped_mass();
  std::vector<PackedSym3> logs;
  for (const Sym3& m : metrics) logs.push_back(pack(log_spd(m)));
  const double before = complexity_of(metrics, weights);
  set_complexity(grid, logs, 8 * before);
  for (std::size_t n = 0; n < 40; ++n) {
    const Sym3 scaled = exp_sym(unpack(logs[n]));
    EXPECT_NEAR(trace(scaled) / trace(metrics[n]), 4, 1e-4);
    metrics[n] = scaled;
  }
  EXPECT_NEAR(complexity_of(metrics, weights) / before, 8, 1e-3);
}

TEST(SizeControl, ScaledSizesStayWithinTheirBounds) {
  const auto before = random_metrics(100);
  std::vector<PackedSym3> logs;
  for (const Sym3& m : before) logs.push_back(pack(log_spd(m)));
  scale_log_sizes(logs, 1.5, {0.3, 2, 0});
  for (std::size_t n = 0; n < logs.size(); ++n) {
    const Sym3 expected = clamp_sizes((1 / 2.25) * before[n], 0.3, 2);
    const Sym3 found = exp_sym(unpack(logs[n]));
    for (const auto entry : {&Sym3::xx, &Sym3::xy, &Sym3::xz, &Sym3::yy, &Sym3::yz, &Sym3::zz}) {
      EXPECT_NEAR(found.*entry, expected.*entry, 1e-4 * trace(expected));
    }
  }
}

TEST(SizeControl, SizesAtTheLargestStay) {
  const Sym3 largest = 0.25 * kIdentity3;
  std::vector<PackedSym3> logs{pack(log_spd(largest))};
  scale_log_sizes(logs, 0.5, {0.3, 2, 0});
  EXPECT_NEAR(exp_sym(unpack(logs[0])).yy, largest.yy, 1e-6);
}

TEST(SizeControl, RefusesWeightsOfAnotherSize) {
  std::vector<Sym3> metrics(3);
  EXPECT_THROW(control_sizes(metrics, std::vector<double>(2, 1), {}), InputError);
}

TEST(ClampedComplexities, AreWhatControlSizesReaches) {
  const auto before = random_metrics(500);
  const std::vector<double> weights(500, 0.1);
  const double bound = complexity_of(before, weights) / 10;
  auto metrics = before;
  const double factor = control_sizes(metrics, weights, {0.05, 3, bound});
  const std::vector<double> factors{1, factor, 4 * factor};
  const std::vector<double> found =
      clamped_complexities(before, weights, {0.05, 3, 12345}, factors);
  ASSERT_EQ(found.size(), 3U);
  EXPECT_NEAR(found[1] / bound, 1, 1e-5);
  EXPECT_NEAR(found[1] / complexity_of(metrics, weights), 1, 1e-6);
  EXPECT_GT(found[0], found[1]);
  EXPECT_GT(found[1], found[2]);
  // Scaled apart, clamped without a bound: the same.
  auto scaled = before;
  for (Sym3& m : scaled) m = 1 / 9.0 * m;
  control_sizes(scaled, weights, {0.05, 3, 0});
  EXPECT_NEAR(clamped_complexities(before, weights, {0.05, 3, 0}, std::vector<double>{3})[0] /
                  complexity_of(scaled, weights),
              1, 1e-6);
}

TEST(ClampedComplexities, OfPartsAddUp) {
  const auto metrics = random_metrics(300);
  const std::vector<double> weights(300, 0.2), factors{1, 2, 5, 30};
  const SizeControl control{0.05, 3, 0};
  const std::span<const Sym3> all(metrics);
  const std::span<const double> shares(weights);
  const auto whole = clamped_complexities(all, shares, control, factors);
  const auto a = clamped_complexities(all.first(110), shares.first(110), control, factors);
  const auto b = clamped_complexities(all.subspan(110), shares.subspan(110), control, factors);
  for (std::size_t i = 0; i < factors.size(); ++i) EXPECT_NEAR((a[i] + b[i]) / whole[i], 1, 1e-12);
}

TEST(ClampedComplexities, RefusesUnequalNumbers) {
  const std::vector<double> weights(4, 1);
  EXPECT_THROW(clamped_complexities(random_metrics(5), weights, {0.05, 3, 0}, weights), InputError);
}

}  // namespace
}  // namespace mesamis
