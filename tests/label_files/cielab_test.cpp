// SPDX-License-Identifier: Apache-2.0
#include "mesamis/label_files/cielab.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace mesamis {
namespace {

using testing::ElementsAre;

/// As a file stores L of 0 to 100 and a, b of -128 to 127.
std::array<int, 3> scaled(double l, double a, double b) {
  const auto stored = [](double value) { return static_cast<int>(std::lround(value)); };
  return {stored(l / 100 * 65535), stored((a + 128) / 255 * 65535),
          stored((b + 128) / 255 * 65535)};
}

TEST(CieLab, GreysAreGrey) {
  EXPECT_THAT(srgb_from_cielab(scaled(0, 0, 0)), ElementsAre(0, 0, 0));
  EXPECT_THAT(srgb_from_cielab(scaled(100, 0, 0)), ElementsAre(255, 255, 255));
  EXPECT_THAT(srgb_from_cielab(scaled(53.585, 0, 0)), ElementsAre(128, 128, 128));
}

// The values that tables of sRGB and Lab (D65) give for the primaries.
TEST(CieLab, PrimariesArePrimaries) {
  EXPECT_THAT(srgb_from_cielab(scaled(53.2408, 80.0925, 67.2032)), ElementsAre(255, 0, 0));
  EXPECT_THAT(srgb_from_cielab(scaled(87.7347, -86.1827, 83.1793)), ElementsAre(0, 255, 0));
  EXPECT_THAT(srgb_from_cielab(scaled(32.2970, 79.1875, -107.8602)), ElementsAre(0, 0, 255));
}

TEST(CieLab, ColoursBeyondSrgbAreClamped) {
  const auto colour = srgb_from_cielab({65535, 65535, 65535});
  EXPECT_EQ(colour[0], 255);
  EXPECT_EQ(colour[2], 0);
}

}  // namespace
}  // namespace mesamis
