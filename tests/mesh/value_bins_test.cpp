// SPDX-License-Identifier: Apache-2.0
#include "mesamis/mesh/value_bins.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "support/throws.h"

namespace mesamis {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

TEST(ValueBins, HoldTheirValuesAndHaveEqualWidths) {
  std::mt19937 random(1);
  std::normal_distribution<double> normal(300, 1000);
  std::vector<double> values(5000);
  for (double& value : values) value = normal(random);
  for (const int count : {1, 2, 7, 10, 999}) {
    const ValueBins bins = equal_bins(values, count);
    ASSERT_EQ(bins.edges.size(), static_cast<std::size_t>(count) + 1);
    EXPECT_EQ(bins.edges.front(), *std::min_element(values.begin(), values.end()));
    EXPECT_EQ(bins.edges.back(), *std::max_element(values.begin(), values.end()));
    const double width = (bins.edges.back() - bins.edges.front()) / count;
    for (std::size_t b = 0; b + 1 < bins.edges.size(); ++b) {
      EXPECT_NEAR(bins.edges[b + 1] - bins.edges[b], width, 1e-9);
    }
    ASSERT_EQ(bins.of_value.size(), values.size());
    for (std::size_t i = 0; i < values.size(); ++i) {
      const auto b = static_cast<std::size_t>(bins.of_value[i]);
      ASSERT_LT(b, static_cast<std::size_t>(count));
      EXPECT_LE(bins.edges[b], values[i]);
      EXPECT_TRUE(values[i] < bins.edges[b + 1] || bins.of_value[i] == count - 1);
      EXPECT_LE(values[i], bins.edges[b + 1]);
    }
  }
}

TEST(ValueBins, BelongToTheUpperBinAtAnEdgeButTheLast) {
  const std::vector<double> values{0, 1, 2, 3, 4};
  EXPECT_THAT(equal_bins(values, 4).of_value, ElementsAre(0, 1, 2, 3, 3));
  EXPECT_THAT(equal_bins(values, 2).of_value, ElementsAre(0, 0, 1, 1, 1));
}

TEST(ValueBins, TakeEqualValuesToo) {
  const std::vector<double> values{7, 7};
  const ValueBins bins = equal_bins(values, 3);
  EXPECT_THAT(bins.edges, ElementsAre(7, 7, 7, 7));
  EXPECT_EQ(bins.of_value[0], bins.of_value[1]);
}

TEST(ValueBins, RefuseNothingAndNumbersThatAreNone) {
  const std::vector<double> one{1}, odd{1, std::nan("")};
  EXPECT_REFUSED(equal_bins(one, 0), HasSubstr("found 0"));
  EXPECT_REFUSED(equal_bins({}, 3), HasSubstr("found none"));
  EXPECT_REFUSED(equal_bins(odd, 3), HasSubstr("finite"));
}

}  // namespace
}  // namespace mesamis
