// SPDX-License-Identifier: Apache-2.0
#include "mesamis/picture/color_scale.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace mesamis {
namespace {

ValueRange range_of(const std::vector<double>& values, double lo = 0, double hi = 1) {
  return percentile_range(std::span<const double>(values), lo, hi);
}

TEST(PercentileRange, CutsSharesOffBothEnds) {
  std::vector<double> values;
  for (int i = 0; i <= 1000; ++i) values.push_back((i * 617) % 1001);  // 0 to 1000, shuffled
  const ValueRange all = range_of(values), middle = range_of(values, 0.25, 0.9);
  EXPECT_EQ(all.lo, 0);
  EXPECT_EQ(all.hi, 1000);
  EXPECT_EQ(middle.lo, 250);
  EXPECT_EQ(middle.hi, 900);
}

TEST(PercentileRange, SamplesLargeArraysEvenly) {
  std::vector<float> values(3'000'000);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = static_cast<float>(i);
  const ValueRange range = percentile_range(std::span<const float>(values), 0.1, 0.9);
  EXPECT_NEAR(range.lo, 300'000, 10);
  EXPECT_NEAR(range.hi, 2'700'000, 10);
}

TEST(PercentileRange, IgnoresWhatIsNotFinite) {
  const double nan = std::nan(""), infinity = std::numeric_limits<double>::infinity();
  const ValueRange range = range_of({nan, 3, infinity, 5, -infinity, 4});
  EXPECT_EQ(range.lo, 3);
  EXPECT_EQ(range.hi, 5);
}

TEST(PercentileRange, AlwaysHasAnExtent) {
  for (const std::vector<double>& values :
       {std::vector<double>{}, {std::nan("")}, {7}, {7, 7}, {0, 0}, {-1e9, -1e9}}) {
    const ValueRange range = range_of(values, 0.005, 0.995);
    EXPECT_LT(range.lo, range.hi);
    if (!values.empty() && std::isfinite(values[0])) {
      EXPECT_LT(range.lo, values[0]);
      EXPECT_GT(range.hi, values[0]);
    }
  }
  std::vector<double> outlier(1000, 2.0);
  outlier[500] = 9;
  EXPECT_EQ(range_of(outlier, 0.005, 0.995).hi, 9) << "rather all values than none";
}

TEST(Grey, RunsFromBlackToWhite) {
  EXPECT_EQ(grey(0), (Colour{0, 0, 0}));
  EXPECT_EQ(grey(1), (Colour{255, 255, 255}));
  EXPECT_EQ(grey(-3), grey(0));
  EXPECT_EQ(grey(3), grey(1));
  EXPECT_EQ(grey(0.5)[0], 128);
}

TEST(Viridis, GrowsLighterAllTheWay) {
  double before = -1;
  for (int i = 0; i <= 200; ++i) {
    const Colour c = viridis(i / 200.0);
    const double luminance = 0.2126 * c[0] + 0.7152 * c[1] + 0.0722 * c[2];
    EXPECT_GE(luminance, before - 0.8) << i;  // colours are rounded to whole numbers
    before = luminance;
  }
  EXPECT_EQ(viridis(-1), viridis(0));
  EXPECT_EQ(viridis(2), viridis(1));
  const Colour dark = viridis(0), light = viridis(1);
  EXPECT_GT(dark[2], dark[1]) << "violet";
  EXPECT_GT(light[0], light[2] + 50) << "yellow";
}

}  // namespace
}  // namespace mesamis
