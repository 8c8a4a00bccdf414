// SPDX-License-Identifier: Apache-2.0
#include "mesamis/picture/lighting.h"

#include <gtest/gtest.h>

namespace mesamis {
namespace {

constexpr Colour kGrey{150, 150, 150};

int brightness(const Vec3& normal, const Reflectance& reflectance = {}) {
  return lit(kGrey, unit_or_zero(normal), reflectance)[0];
}

TEST(Lit, ComesFromTheUpperLeftAndTheViewer) {
  EXPECT_GT(brightness({-1, 1, 1}), brightness({1, -1, 1}));
  EXPECT_GT(brightness({-1, 1, 1}), brightness({1, 1, 1}));
  EXPECT_GT(brightness({0, 0, 1}), brightness({0.9, 0, 0.4}));
  EXPECT_GT(brightness({1, -0.5, 0.1}), brightness({0.9, 0.9, 0.1})) << "the weaker light";
}

TEST(Lit, LeavesTheAmbientShareWhereNoLightReaches) {
  EXPECT_EQ(lit({100, 50, 0}, {0, 0, -1}, {0.5, 1, 1}), (Colour{50, 25, 0}));
}

TEST(Lit, KeepsTheColourButForItsGloss) {
  const Colour matt = lit({200, 100, 0}, {0, 0, 1}, {0.1, 0.8, 0});
  EXPECT_NEAR(matt[0], 2 * matt[1], 1);
  EXPECT_EQ(matt[2], 0);
  EXPECT_GT(lit({200, 100, 0}, {0, 0, 1}, {0.1, 0.8, 0.2})[2], 10);
}

TEST(Lit, DoesNotOverflow) {
  EXPECT_EQ(lit({255, 255, 255}, unit_or_zero({-0.7, 0.9, 1}), {1, 1, 1}), (Colour{255, 255, 255}));
}

}  // namespace
}  // namespace mesamis
