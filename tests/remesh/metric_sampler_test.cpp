// SPDX-License-Identifier: Apache-2.0
#include "mesamis/remesh/metric_sampler.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "mesamis/base/sym3.h"
#include "mesamis/remesh/geometry.h"
#include "support/metric_fields.h"

namespace mesamis {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

MetricFactor sampled(const Sym3& m, double size_factor = 1) {
  const FormulaMetric field([m](const Vec3&) { return m; });
  MetricSampler sampler(field, kUnitBox);
  sampler.set_size_factor(size_factor);
  Index hint = 0;
  return sampler.at({0.5, 0.5, 0.5}, hint);
}

/// A metric with sizes from 1 to 1000 in random directions.
Sym3 random_metric(std::mt19937& generator) {
  std::uniform_real_distribution<double> uniform(-1, 1);
  Sym3 m;
  for (int i = 0; i < 3; ++i) {
    m += std::pow(10, 3 + 3 * uniform(generator)) *
         outer(Vec3{uniform(generator), uniform(generator), uniform(generator)});
  }
  return m + 1e-3 * trace(m) * kIdentity3;
}

Vec3 random_vector(std::mt19937& generator) {
  std::uniform_real_distribution<double> uniform(-1, 1);
  return {uniform(generator), uniform(generator), uniform(generator)};
}

TEST(MetricSampler, FactorsGiveTheLengthsOfTheMetric) {
  std::mt19937 generator(1);
  for (int i = 0; i < 500; ++i) {
    const Sym3 m = random_metric(generator);
    const MetricFactor l = sampled(m);
    const Vec3 e = random_vector(generator);
    // L is rounded to float, at the scale of its largest entries.
    const double scale = std::sqrt(trace(m)) * norm(e);
    EXPECT_NEAR(std::sqrt(squared_length(l, e)), std::sqrt(quadratic_form(m, e)), 1e-6 * scale);
    EXPECT_NEAR(density(l) / std::sqrt(determinant(m)), 1, 1e-3);
  }
}

TEST(MetricSampler, FactorsAreTakenAndUndone) {
  std::mt19937 generator(2);
  for (int i = 0; i < 500; ++i) {
    const Sym3 m = random_metric(generator);
    const MetricFactor l = sampled(m);
    const Vec3 e = random_vector(generator);
    EXPECT_LT(norm(out_of_metric(l, in_metric(l, e)) - e), 1e-10);
    EXPECT_LT(norm(solve_metric(l, from_metric(l, in_metric(l, e))) - e), 1e-8);
    EXPECT_LT(norm(from_metric(l, in_metric(l, e)) - m * e), 1e-5 * trace(m) * norm(e));
  }
}

TEST(MetricSampler, SizesAreMultipliedByTheFactor) {
  const Sym3 m{9, 1, 0, 4, 1, 2};
  const MetricFactor plain = sampled(m), larger = sampled(m, 4);  // 4: no rounding
  EXPECT_EQ(larger.xx, plain.xx / 4);
  EXPECT_EQ(larger.yx, plain.yx / 4);
  EXPECT_EQ(larger.zz, plain.zz / 4);
}

TEST(MetricSampler, MakesEveryAnswerSafe) {
  // The box has a diagonal of sqrt(3): sizes lie between 1e-10 and 1e4 times it.
  const double diagonal = std::sqrt(3.0);
  const Sym3 hostile[]{{},
                       {kNaN, 0, 0, 1, 0, 1},
                       {1, kInfinity, 0, 1, 0, 1},
                       {1e300, 0, 0, 1, 0, 1e-300},
                       {1e308, 1e308, 1e308, 1e308, 1e308, 1e308},
                       {-1, 0, 0, -1, 0, -1},
                       {1, 5, 5, 1, 5, 1},  // indefinite
                       {1e-300, 0, 0, 1e-300, 0, 1e-300}};
  for (const Sym3& m : hostile) {
    const MetricFactor l = sampled(m);
    for (const float entry : {l.xx, l.yx, l.zx, l.yy, l.zy, l.zz}) {
      EXPECT_TRUE(std::isfinite(entry));
      EXPECT_LE(std::abs(entry), 1.01 / (1e-10 * diagonal));
    }
    for (const float pivot : {l.xx, l.yy, l.zz}) EXPECT_GE(pivot, 0.99 / (1e4 * diagonal));
  }
}

}  // namespace
}  // namespace mesamis
