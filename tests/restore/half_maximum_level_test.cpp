// SPDX-License-Identifier: Apache-2.0
#include "mesamis/restore/half_maximum_level.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <ostream>
#include <string>

#include "mesamis/phantom/degrade.h"
#include "support/ball_volume.h"
#include "support/sampled_volume.h"

namespace mesamis {
namespace {

struct Case {
  std::string name;
  BallVolume ball;
  double level;  // the truth
};

void PrintTo(const Case& c, std::ostream* out) { *out << c.name; }

class HalfMaximum : public ::testing::TestWithParam<Case> {};

TEST_P(HalfMaximum, IsMidwayBetweenBackgroundAndObject) {
  const Case& c = GetParam();
  const Volume volume = make_ball(c.ball);
  const HalfMaximumLevel object = find_half_maximum_level(volume);
  const double contrast = c.ball.object - c.ball.background;
  EXPECT_NEAR(object.level, c.level, 0.05 * contrast);
  // What blur is left 1.5 voxels away pulls both medians alike.
  EXPECT_NEAR(object.contrast.object, c.ball.object, 0.15 * contrast);
  EXPECT_NEAR(object.contrast.background, c.ball.background, 0.15 * contrast);
  const double area = 4 * std::numbers::pi * c.ball.radius * c.ball.radius;
  EXPECT_NEAR(object.area, area, 0.12 * area);  // the blur shrinks it
  // Another level to measure at changes the area alone.
  const HalfMaximumLevel elsewhere =
      find_half_maximum_level(volume, {.area_at = c.ball.object + 1000});
  EXPECT_EQ(elsewhere.area, 0);
  EXPECT_EQ(elsewhere.level, object.level);
}

INSTANTIATE_TEST_SUITE_P(
    Phantoms, HalfMaximum,
    ::testing::Values(
        Case{"quiet", {.background = 120, .object = 230, .noise = 4}, 175},
        Case{"noisy", {.background = 120, .object = 230, .noise = 15}, 175},
        Case{"very_noisy", {.background = 120, .object = 230, .noise = 30}, 175},
        Case{"small_bright", {.background = 5, .object = 90, .noise = 2, .radius = 6}, 47.5},
        // Air around a soft ball around bone, in HU: the skin must not shift the level.
        Case{"ct", {.background = 40, .object = 900, .noise = 20, .air = -1000}, 470}),
    [](const auto& parameter) { return parameter.param.name; });

TEST(HalfMaximumOfANoisyImage, IsFoundThoughTheObjectIsSmall) {
  // Two hundredths of the voxels: the best split of all values is one of the noise.
  Volume scan = sampled_volume({96, 96, 96}, {1, 1, 1}, [](const Vec3& p) {
    return norm(p - Vec3{40, 50, 45}) < 12 ? 230 : 120;
  });
  scan = degrade(scan, {.blur = 1, .noise = 30});
  EXPECT_NEAR(find_half_maximum_level(scan).level, 175, 6);
}

TEST(HalfMaximumLevel, ShiftsAndScalesWithTheImage) {
  Volume volume = make_ball({.noise = 6});
  const HalfMaximumLevel before = find_half_maximum_level(volume);
  for (float& x : volume.samples) x = 2 * x + 16;
  const HalfMaximumLevel after = find_half_maximum_level(volume);
  EXPECT_NEAR(after.level, 2 * before.level + 16, 0.5);
  EXPECT_NEAR(after.contrast.difference(), 2 * before.contrast.difference(), 0.5);
  EXPECT_NEAR(after.area / before.area, 1, 1e-3);
}

TEST(HalfMaximumLevel, StaysAtAStartWithoutASurface) {
  const Volume volume = make_ball({.noise = 0});
  const HalfMaximumLevel object = find_half_maximum_level(volume, {.start = 900});
  EXPECT_EQ(object.level, 900);
  EXPECT_EQ(object.contrast.difference(), 0);
  EXPECT_EQ(object.area, 0);
}

}  // namespace
}  // namespace mesamis
