// SPDX-License-Identifier: Apache-2.0
#include "mesamis/picture/series_style.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <string>
#include <tuple>

namespace mesamis {
namespace {

/// Relative luminance after WCAG 2, from "#rrggbb": 0 black, 1 white.
double luminance(const std::string& color) {
  const auto channel = [&color](std::size_t at) {
    const double c = std::stoi(color.substr(at, 2), nullptr, 16) / 255.0;
    return c <= 0.03928 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
  };
  return 0.2126 * channel(1) + 0.7152 * channel(3) + 0.0722 * channel(5);
}

TEST(SeriesStyle, TwentySeriesDifferInDashesOrMarker) {
  std::set<std::tuple<std::string, std::string, bool>> seen;
  for (std::size_t i = 0; i < 20; ++i) {
    const SeriesStyle style = series_style(i);
    EXPECT_TRUE(seen.insert({style.dashes, style.marker, style.filled}).second) << i;
  }
}

TEST(SeriesStyle, ConsecutiveSeriesDifferInEverything) {
  for (std::size_t i = 0; i < 40; ++i) {
    const SeriesStyle a = series_style(i), b = series_style(i + 1);
    EXPECT_STRNE(a.color, b.color);
    EXPECT_STRNE(a.dashes, b.dashes);
    EXPECT_STRNE(a.marker, b.marker);
    EXPECT_GT(std::abs(luminance(a.color) - luminance(b.color)), 0.01) << i;
  }
}

TEST(SeriesStyle, ColoursStandOutFromWhite) {
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_GE(1.05 / (luminance(series_style(i).color) + 0.05), 3) << series_style(i).color;
  }
}

}  // namespace
}  // namespace mesamis
