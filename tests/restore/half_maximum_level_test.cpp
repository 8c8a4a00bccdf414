// SPDX-License-Identifier: Apache-2.0
#include "mesamis/restore/half_maximum_level.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <ostream>
#include <string>

#include "mesamis/image/grey_values.h"
#include "mesamis/phantom/degrade.h"
#include "mesamis/phantom/phantom.h"
#include "mesamis/restore/level_crossings.h"
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
  const Volume guide = smoothed(volume);
  EXPECT_NEAR(level_area(guide, object.level), area, 0.12 * area);  // the blur shrinks it
  EXPECT_EQ(level_area(guide, c.ball.object + 1000), 0);
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
  const double area_before = level_area(smoothed(volume), before.level);
  for (float& x : volume.samples) x = 2 * x + 16;
  const HalfMaximumLevel after = find_half_maximum_level(volume);
  EXPECT_NEAR(after.level, 2 * before.level + 16, 0.5);
  EXPECT_NEAR(after.contrast.difference(), 2 * before.contrast.difference(), 0.5);
  EXPECT_NEAR(level_area(smoothed(volume), after.level) / area_before, 1, 1e-3);
}

TEST(HalfMaximumLevel, StaysAtAStartWithoutASurface) {
  const Volume volume = make_ball({.noise = 0});
  const HalfMaximumLevel object = find_half_maximum_level(volume, {.start = 900});
  EXPECT_EQ(object.level, 900);
  EXPECT_EQ(object.contrast.difference(), 0);
  EXPECT_EQ(level_area(smoothed(volume), object.level), 0);
}

TEST(HalfMaximumLevel, FindsThinPlatesInNoise) {
  // Two voxels of 230 in 120, 2 % of the volume, seen through the blur.
  for (const std::uint64_t seed : {2, 3, 4, 5}) {
    const Phantom plate = make_phantom("plate", {64, 64, 26}, {1, 1, 2.5});
    const Volume scan = degrade(sample_phantom(plate), {.blur = 1, .noise = 15, .seed = seed});
    const HalfMaximumLevel object = find_half_maximum_level(scan);
    EXPECT_FALSE(object.in_noise) << seed;
    EXPECT_GT(object.level, 120 + 0.1 * 110) << seed;
    EXPECT_LT(object.level, 175) << seed;
  }
}

TEST(HalfMaximumLevel, TellsObjectsFromNoise) {
  for (unsigned seed = 1; seed <= 3; ++seed) {
    BallVolume noise{.size = 48, .object = 120, .noise = 15, .seed = seed};
    const HalfMaximumLevel nothing = find_half_maximum_level(make_ball(noise));
    EXPECT_TRUE(nothing.in_noise || nothing.contrast.difference() == 0) << seed;
    BallVolume ball{.size = 48, .noise = 60, .radius = 14, .seed = seed};
    EXPECT_FALSE(find_half_maximum_level(make_ball(ball)).in_noise) << seed;
    BallVolume hole = ball;  // what is around fills more than half
    std::swap(hole.background, hole.object);
    EXPECT_FALSE(find_half_maximum_level(make_ball(hole)).in_noise) << seed;
  }
}

}  // namespace
}  // namespace mesamis
