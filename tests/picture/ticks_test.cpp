// SPDX-License-Identifier: Apache-2.0
#include "mesamis/picture/ticks.h"

#include <gmock/gmock.h>

#include <clocale>
#include <cmath>

namespace mesamis {
namespace {

using testing::ElementsAre;

std::vector<std::string> labels_of(const Ticks& ticks) {
  std::vector<double> values;
  for (int i = 0; i < ticks.count; ++i) values.push_back(ticks.at(i));
  return tick_labels(values, ticks.step);
}

TEST(Ticks, AreTheKnownRoundNumbers) {
  EXPECT_THAT(labels_of(round_ticks(0, 1, 5)),
              ElementsAre("0.0", "0.2", "0.4", "0.6", "0.8", "1.0"));
  EXPECT_THAT(labels_of(round_ticks(-3, 12, 4)), ElementsAre("0", "5", "10"));
  EXPECT_THAT(labels_of(round_ticks(-101, -49, 3)), ElementsAre("−100", "−80", "−60"));
}

TEST(Ticks, LieInTheRangeAtRoundNumbersAndAreAboutAsMany) {
  for (int i = 0; i < 2000; ++i) {
    const double lo = std::pow(10.0, i % 13 - 6) * std::sin(i);
    const double hi = lo + std::pow(10.0, (i * 7) % 11 - 5) * (1.1 + std::cos(3 * i));
    const int count = 1 + i % 12;
    const Ticks ticks = round_ticks(lo, hi, count);
    const double mantissa = ticks.step / std::pow(10.0, std::floor(std::log10(ticks.step) + 1e-9));
    EXPECT_TRUE(std::abs(mantissa - 1) < 1e-6 || std::abs(mantissa - 2) < 1e-6 ||
                std::abs(mantissa - 5) < 1e-6)
        << mantissa;
    EXPECT_LE(ticks.count, count + 1);
    EXPECT_GE(ticks.count, static_cast<int>(0.4 * count));
    EXPECT_DOUBLE_EQ(ticks.first / ticks.step, std::round(ticks.first / ticks.step));
    EXPECT_GE(ticks.first, lo - 1e-6 * ticks.step);
    EXPECT_GT(ticks.at(ticks.count), hi) << "one more would lie outside";
    if (ticks.count == 0) continue;
    EXPECT_LE(ticks.at(ticks.count - 1), hi + 1e-6 * ticks.step);
  }
}

TEST(TickLabels, HaveTheDecimalsOfTheStep) {
  EXPECT_THAT(tick_labels({0.25, 0.5}, 0.05), ElementsAre("0.25", "0.50"));
  EXPECT_THAT(tick_labels({12345.5, 12346}, 0.5), ElementsAre("12 345.5", "12 346.0"));
  EXPECT_THAT(tick_labels({9999, 10000, 1234567}, 1), ElementsAre("9999", "10 000", "1 234 567"));
  EXPECT_THAT(tick_labels({0.1 + 0.2 - 0.3}, 0.1), ElementsAre("0.0")) << "no trace of rounding";
}

TEST(TickLabels, UsePowersOfTenForLargeAndTinyNumbers) {
  EXPECT_THAT(tick_labels({0, 5e6, 1e7}, 5e6), ElementsAre("0", "5·10⁶", "1.0·10⁷"));
  EXPECT_THAT(tick_labels({2.5e12}, 1e11), ElementsAre("2.5·10¹²"));
  EXPECT_THAT(tick_labels({-3e-20}, 1e-20), ElementsAre("−3·10⁻²⁰"));
  EXPECT_THAT(tick_labels({1e-5}, 1e-5), ElementsAre("0.00001"));
}

TEST(TickLabels, DoNotDependOnTheLocale) {
  const std::string before = std::setlocale(LC_NUMERIC, nullptr);
  for (const char* name : {"de_DE.UTF-8", "de_DE.utf8", "fr_FR.UTF-8"}) {
    std::setlocale(LC_NUMERIC, name);  // where it is installed
    EXPECT_THAT(tick_labels({0.5}, 0.5), ElementsAre("0.5"));
  }
  std::setlocale(LC_NUMERIC, before.c_str());
}

}  // namespace
}  // namespace mesamis
