// SPDX-License-Identifier: Apache-2.0
#include "mesamis/restore/level_crossings.h"

#include <gtest/gtest.h>

#include <numbers>

#include "support/ball_volume.h"
#include "support/sampled_volume.h"

namespace mesamis {
namespace {

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

TEST(CrossingPoints, AreNoneWhereTheLevelIsNotReached) {
  const Volume volume = make_ball({.noise = 0});
  EXPECT_TRUE(crossing_points(volume, 300, 1000).empty());
  EXPECT_EQ(level_area(volume, 300), 0);
}

TEST(CrossingPoints, OfALinearImageLieOnItsPlane) {
  const Vec3 slope{3, -1, 2};
  const Volume volume =
      sampled_volume({9, 12, 10}, {0.5, 1, 2}, [&](const Vec3& p) { return dot(slope, p); });
  for (const SurfacePoint& point : crossing_points(volume, 17, 100'000)) {
    EXPECT_NEAR(dot(slope, point.position), 17, 1e-4);
    EXPECT_LT(norm(point.normal + (1 / norm(slope)) * slope), 1e-5);
  }
}

TEST(GradientAt, IsExactOnLinearImagesUpToTheBorder) {
  const Vec3 slope{3, -1, 2};
  const Volume volume =
      sampled_volume({4, 3, 2}, {0.5, 1, 2}, [&](const Vec3& p) { return dot(slope, p); });
  for (Index k = 0; k < 2; ++k) {
    for (Index j = 0; j < 3; ++j) {
      for (Index i = 0; i < 4; ++i) EXPECT_LT(norm(gradient_at(volume, i, j, k) - slope), 1e-5);
    }
  }
}

TEST(LevelArea, IsThatOfABallInVoxelsOfAnyShape) {
  for (const Vec3& spacing : {Vec3{1, 1, 1}, Vec3{1, 0.8, 1.3}}) {
    const Volume volume = make_ball({.spacing = spacing, .noise = 0, .radius = 11, .blur = 0.5});
    const double area = 4 * std::numbers::pi * 11 * 11;
    EXPECT_NEAR(level_area(volume, 175) / area, 1, 0.03);
  }
}

}  // namespace
}  // namespace mesamis
