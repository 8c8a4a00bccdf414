// SPDX-License-Identifier: Apache-2.0
#include "mesamis/restore/object_edge.h"

#include <gtest/gtest.h>

#include <cmath>

#include "mesamis/image/gaussian.h"
#include "support/ball_volume.h"
#include "support/sampled_volume.h"

namespace mesamis {
namespace {

/// A ball, and many plates so thin that they reach half of the ball's value.
Volume ball_and_plates(double plates_to) {
  Volume volume = sampled_volume({64, 48, 48}, {1, 1, 1}, [plates_to](const Vec3& p) {
    const bool ball = norm(p - Vec3{14, 24, 24}) < 10;
    const bool plate = p.x > 29.5 && p.x < plates_to && std::fmod(p.x, 6) < 1;
    return ball || plate ? 230.0 : 120.0;
  });
  return gaussian_smoothed(std::move(volume), 0.8);
}

TEST(WindowWithRoom, HoldsHalfTheContrastOnBothSidesOfTheLevel) {
  const Volume volume = ball_and_plates(60);
  const Window usual = default_window(volume, 120);
  const auto window = [&](double background, double object, double level) {
    return window_with_room(volume, {background, object, 0}, level);
  };
  EXPECT_EQ(window(120, 130, 175).low, usual.low) << "there is room";
  EXPECT_EQ(window(120, 130, 175).high, usual.high);
  EXPECT_EQ(window(120, 230, usual.low).low, usual.low - 55);
  EXPECT_EQ(window(120, 230, usual.high).high, usual.high + 55);
  EXPECT_EQ(window(230, 120, usual.high).high, usual.high + 55) << "a dark object";
}

TEST(ObjectEdge, IsThatOfTheThickPart) {
  const Volume volume = ball_and_plates(60);
  const HalfMaximumLevel seen = find_half_maximum_level(volume);
  const HalfMaximumLevel object = find_object_edge(volume, seen);
  EXPECT_NEAR(object.level, 175, 0.03 * 110);
  EXPECT_NEAR(object.contrast.background, 120, 3);
  EXPECT_NEAR(object.contrast.object, 230, 6);
}

TEST(ObjectEdge, DoesNotDependOnTheCrop) {
  const Volume whole = ball_and_plates(60);
  const Volume part = crop(whole, {{0, 4, 2}, {47, 46, 48}});
  const double in_whole = find_object_edge(whole, find_half_maximum_level(whole)).level;
  const double in_part = find_object_edge(part, find_half_maximum_level(part)).level;
  EXPECT_NEAR(in_part, in_whole, 0.02 * 110);
}

TEST(ObjectEdge, IsMidwayForAShellWhoseBackIsSeen) {
  // The back is no lighter core: a shell 3.4 voxels thick, and one that is hardly thicker than the
  // blur lets it show.
  for (const double thickness : {2.6, 3.4}) {
    const Volume ball = sampled_volume({48, 48, 48}, {1, 1, 1}, [thickness](const Vec3& p) {
      const double r = norm(p - Vec3{23.6, 23.8, 24.1});
      return r < 18 && r > 18 - thickness ? 230.0 : 120.0;
    });
    const Volume scan = gaussian_smoothed(ball, 0.8);
    EXPECT_NEAR(find_object_edge(scan, find_half_maximum_level(scan)).level, 175, 0.03 * 110)
        << thickness;
  }
}

TEST(ObjectEdge, GoesTowardsTheWholeSurfaceWhereTheObjectVaries) {
  for (const double spread : {0.0, 25.0}) {
    const Volume blocks = gaussian_smoothed(
        sampled_volume({72, 40, 40}, {1, 1, 1},
                       [spread](const Vec3& p) {
                         const int at = static_cast<int>(p.x / 18);
                         const double x = p.x - 18 * at;
                         return x > 3.5 && x < 14.5 ? 230 + spread * (at - 1.5) : 120;
                       }),
        0.8);
    const HalfMaximumLevel seen = find_half_maximum_level(blocks);
    HalfMaximumLevel lower = seen;
    lower.level -= 10;  // as if more of the surface were thin
    lower.contrast.object -= 20;
    const HalfMaximumLevel object = find_object_edge(blocks, seen);
    const HalfMaximumLevel with_thin = find_object_edge(blocks, lower);
    const double share = spread > 0 ? 0.5 : 0;
    EXPECT_NEAR(object.level - with_thin.level, share * 10, 0.5) << spread;
    EXPECT_NEAR(object.contrast.object - with_thin.contrast.object, share * 20, 1) << spread;
  }
}

TEST(ObjectEdge, IsAsSeenWhereThereIsNone) {
  const Volume flat = sampled_volume({12, 12, 12}, {1, 1, 1}, [](const Vec3&) { return 7; });
  const HalfMaximumLevel seen = find_half_maximum_level(flat);
  EXPECT_EQ(find_object_edge(flat, seen).level, seen.level);
}

TEST(ObjectEdge, HoldsInNoise) {
  for (const double noise : {4.0, 15.0, 30.0}) {
    const Volume ball = make_ball({.size = 48, .noise = noise, .radius = 15});
    EXPECT_NEAR(find_object_edge(ball, find_half_maximum_level(ball)).level, 175, 0.04 * 110)
        << noise;
  }
}

}  // namespace
}  // namespace mesamis
