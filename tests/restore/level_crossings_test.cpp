// SPDX-License-Identifier: Apache-2.0
#include "mesamis/restore/level_crossings.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <random>

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

/// Every n-th of all crossings, counted voxel by voxel and there along x, y, z.
TEST(CrossingPoints, AreTakenEvenlyInTheOrderOfTheVoxels) {
  std::mt19937 generator(6);
  std::uniform_real_distribution<double> uniform(0, 1);
  const Volume volume =
      sampled_volume({19, 7, 5}, {1, 2, 3}, [&](const Vec3&) { return uniform(generator); });
  const double level = volume.samples[40];  // a sample at the level is not above it
  std::vector<Vec3> all;
  const auto visit = [&](std::array<Index, 3> at, int axis) {
    auto next = at;
    if (++next[static_cast<std::size_t>(axis)] == volume.size[static_cast<std::size_t>(axis)]) {
      return;
    }
    const double a = volume.at(at[0], at[1], at[2]), b = volume.at(next[0], next[1], next[2]);
    if ((a > level) == (b > level)) return;
    Vec3 p{at[0] * 1.0, at[1] * 2.0, at[2] * 3.0};
    p[axis] += (level - a) / (b - a) * volume.spacing[axis];
    all.push_back(p);
  };
  for (Index n = 0; n < 19 * 7 * 5; ++n) {
    for (int axis = 0; axis < 3; ++axis) visit({n % 19, n / 19 % 7, n / 133}, axis);
  }
  for (const std::size_t most : {std::size_t{1}, all.size() / 7, all.size(), 2 * all.size()}) {
    const std::size_t every = std::max<std::size_t>(1, all.size() / most);
    const auto points = crossing_points(volume, level, most);
    ASSERT_EQ(points.size(), (all.size() + every - 1) / every);
    for (std::size_t n = 0; n < points.size(); ++n) {
      EXPECT_LT(norm(points[n].position - all[n * every]), 1e-6);
    }
  }
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
