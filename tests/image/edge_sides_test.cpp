// SPDX-License-Identifier: Apache-2.0
#include "mesamis/image/edge_sides.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <ostream>
#include <string>

#include "support/ball_volume.h"

namespace mesamis {
namespace {

struct Case {
  std::string name;
  BallVolume ball;
  double middle;  // the truth
  bool needs_threshold;
};

void PrintTo(const Case& c, std::ostream* out) { *out << c.name; }

class FindObject : public ::testing::TestWithParam<Case> {};

TEST_P(FindObject, LevelLiesMidwayBetweenTheSides) {
  const Case& c = GetParam();
  const Volume volume = make_ball(c.ball);
  const ObjectEdges object = find_object(volume);
  const double contrast = c.ball.object - c.ball.background;
  EXPECT_NEAR(object.level, c.middle, 0.05 * contrast);
  // Medians a step away from a blurred edge: what blur is left pulls both alike.
  EXPECT_NEAR(object.sides.inside, c.ball.object, 0.15 * contrast);
  EXPECT_NEAR(object.sides.outside, c.ball.background, 0.15 * contrast);
  const double threshold = find_threshold(volume, object.sides, object.level, c.ball.noise);
  if (c.needs_threshold) {
    EXPECT_GE(threshold, c.ball.background - 0.05 * contrast);
    EXPECT_LE(threshold, (c.ball.background + object.level) / 2 + 0.05 * contrast);
  } else {
    EXPECT_LT(threshold, -1e30);
  }
  const double area = 4 * std::numbers::pi * c.ball.radius * c.ball.radius;
  EXPECT_NEAR(object.area, area, 0.12 * area);  // the blur shrinks it
  // Another level to measure at changes the area alone.
  const ObjectEdges elsewhere = find_object(volume, {.area_at = c.ball.object + 1000});
  EXPECT_EQ(elsewhere.area, 0);
  EXPECT_EQ(elsewhere.level, object.level);
}

INSTANTIATE_TEST_SUITE_P(
    Phantoms, FindObject,
    ::testing::Values(
        Case{"quiet", {.background = 120, .object = 230, .noise = 4}, 175, false},
        Case{"noisy", {.background = 120, .object = 230, .noise = 15}, 175, false},
        Case{"very_noisy", {.background = 120, .object = 230, .noise = 30}, 175, false},
        Case{"small_bright", {.background = 5, .object = 90, .noise = 2, .radius = 6}, 47.5, false},
        // Air around a soft ball around bone, in HU: the skin must not drag the level.
        Case{"ct", {.background = 40, .object = 900, .noise = 20, .air = -1000}, 470, true}),
    [](const auto& parameter) { return parameter.param.name; });

TEST(MeasureSides, GivesUpWithoutPoints) {
  const Volume volume = make_ball({});
  EXPECT_FALSE(measure_sides(volume, volume, {}, 175).has_value());
}

TEST(CrossingPoints, LieOnTheBallAndPointOutwards) {
  const BallVolume ball{.noise = 0};
  const Volume volume = make_ball(ball);
  const Vec3 center = 0.5 * volume.box().extent();
  const auto points = crossing_points(volume, 175, 100'000);
  EXPECT_GT(points.size(), 1000u);
  for (const SurfacePoint& point : points) {
    EXPECT_NEAR(norm(point.position - center), ball.radius, 0.3);
    EXPECT_GT(dot(point.normal, point.position - center), 0.9 * ball.radius);
  }
  const auto fewer = crossing_points(volume, 175, 500);
  EXPECT_LE(fewer.size(), 1000u);
  EXPECT_GE(fewer.size(), 400u);
}

}  // namespace
}  // namespace mesamis
