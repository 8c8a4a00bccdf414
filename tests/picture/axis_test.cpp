// SPDX-License-Identifier: Apache-2.0
#include "mesamis/picture/axis.h"

#include <gmock/gmock.h>

#include <cmath>

#include "support/throws.h"

namespace mesamis {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

TEST(Axis, LinearSharesAreProportional) {
  const Axis axis = make_axis({3, 11}, {});
  EXPECT_EQ(axis.share(axis.lo), 0);
  EXPECT_EQ(axis.share(axis.hi), 1);
  EXPECT_NEAR(axis.share((axis.lo + axis.hi) / 2), 0.5, 1e-15);
  EXPECT_NEAR(axis.hi - axis.lo, 1.08 * 8, 1e-12) << "4 % on each side";
}

TEST(Axis, DoesNotExtendBeyondZero) {
  EXPECT_EQ(make_axis({0, 5}, {}).lo, 0);
  EXPECT_EQ(make_axis({-5, 0}, {}).hi, 0);
  EXPECT_EQ(make_axis({2, 5}, {.include_zero = true}).lo, 0);
  EXPECT_EQ(make_axis({-5, -2}, {.include_zero = true}).hi, 0);
  const Axis both = make_axis({-5, 5}, {.include_zero = true});
  EXPECT_LT(both.lo, -5);
  EXPECT_GT(both.hi, 5);
}

TEST(Axis, LogarithmicSharesGrowByTheFactor) {
  const Axis axis = make_axis({2, 200, -7, 0}, {.log_scale = true});
  EXPECT_NEAR(axis.share(20), 0.5, 1e-12) << "the geometric mean";
  EXPECT_NEAR(axis.share(40) - axis.share(20), axis.share(8) - axis.share(4), 1e-12);
  EXPECT_EQ(axis.share(0), 0);
  EXPECT_EQ(axis.share(-7), 0);
  EXPECT_NEAR(axis.lo, 2 / 1.5, 1e-12);
  EXPECT_NEAR(axis.hi, 300, 1e-12);
}

TEST(Axis, LogarithmicTicksAreRoundNumbers) {
  EXPECT_THAT(make_axis({1, 40}, {.log_scale = true}).labels,
              ElementsAre("1", "2", "5", "10", "20", "50"));
  EXPECT_THAT(make_axis({0.001, 1e5}, {.log_scale = true, .tick_count = 9}).labels,
              ElementsAre("0.001", "0.01", "0.1", "1", "10", "100", "1000", "10 000", "100 000"));
  EXPECT_THAT(make_axis({1, 1e12}, {.log_scale = true, .tick_count = 4}).ticks,
              ElementsAre(1, 1e4, 1e8, 1e12))
      << "every fourth power";
  EXPECT_THAT(make_axis({30, 60}, {.log_scale = true, .tick_count = 4}).ticks,
              ElementsAre(20, 40, 60, 80))
      << "in less than a decade the ticks of a linear axis";
}

TEST(Axis, HasNoTicksBetweenWholeNumbers) {
  EXPECT_THAT(make_axis({1, 2, 3}, {.tick_count = 10}).labels, ElementsAre("1", "2", "3"));
  EXPECT_GT(make_axis({1, 2, 2.5}, {.tick_count = 10}).ticks.size(), 5u);
}

TEST(Axis, TicksLieInTheRange) {
  for (int i = 0; i < 1000; ++i) {
    const double size = std::pow(10.0, (i * 37) % 601 - 300);
    const std::vector<double> values{size * (1.01 + std::sin(i)), size * (1.01 + std::cos(5 * i))};
    for (const bool log_scale : {false, true}) {
      const Axis axis = make_axis(values, {.log_scale = log_scale, .tick_count = 1 + i % 10});
      ASSERT_LT(axis.lo, axis.hi);
      EXPECT_EQ(axis.ticks.size(), axis.labels.size());
      EXPECT_FALSE(axis.ticks.empty());
      for (const double tick : axis.ticks) {
        EXPECT_GE(axis.share(tick), -1e-6);
        EXPECT_LE(axis.share(tick), 1 + 1e-6);
      }
      for (const double value : values) {
        EXPECT_GT(axis.share(value), 0);
        EXPECT_LT(axis.share(value), 1);
      }
    }
  }
}

TEST(Axis, IsThereForValuesWithoutExtent) {
  for (const double value : {0.0, 5.0, -5.0, 1e-300, 1e300, -1e300}) {
    for (const bool include_zero : {false, true}) {
      const Axis axis = make_axis({value, value}, {.include_zero = include_zero});
      EXPECT_LT(axis.lo, axis.hi) << value;
      EXPECT_FALSE(axis.ticks.empty()) << value;
      EXPECT_GE(axis.share(value), 0) << value;
      EXPECT_LE(axis.share(value), 1) << value;
    }
  }
  const Axis close = make_axis({1, 1 + 1e-15}, {});
  EXPECT_LT(close.lo, 0.9) << "rounding errors are no extent";
}

TEST(Axis, NeedsAPositiveValueForALogarithm) {
  EXPECT_REFUSED(make_axis({0, -1}, {.log_scale = true}), HasSubstr("positive"));
}

}  // namespace
}  // namespace mesamis
