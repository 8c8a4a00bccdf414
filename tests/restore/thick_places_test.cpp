// SPDX-License-Identifier: Apache-2.0
#include "mesamis/restore/thick_places.h"

#include <gtest/gtest.h>

#include "mesamis/image/grey_values.h"
#include "support/ball_volume.h"
#include "support/sampled_volume.h"

namespace mesamis {
namespace {

constexpr double kLevel = 175;

/// A wall two voxels thick, and a block ten thick, both across x.
Volume wall_and_block() {
  return sampled_volume({50, 30, 30}, {1, 1, 1}, [](const Vec3& p) {
    const bool wall = p.x > 7.5 && p.x<9.5, block = p.x> 20.5 && p.x < 30.5;
    return wall || block ? 230.0 : 120.0;
  });
}

TEST(ThickPlaces, AreOnTheThickPartAlone) {
  const Volume volume = wall_and_block();
  const Volume guide = smoothed(volume);
  const auto points = crossing_points(guide, kLevel, 100'000);
  const auto thick = thick_places(guide, points, kLevel);
  EXPECT_GT(thick.points.size(), points.size() / 8);
  EXPECT_LT(thick.points.size(), points.size());
  EXPECT_EQ(thick.least, kLongestWay);
  for (const SurfacePoint& point : thick.points) EXPECT_GT(point.position.x, 15);
}

TEST(ThickPlaces, AreNotBesideAnotherPart) {
  // A gap of two voxels between two blocks: its sides are no free surface.
  const Volume volume = sampled_volume({40, 20, 20}, {1, 1, 1}, [](const Vec3& p) {
    const bool first = p.x > 5.5 && p.x<17.5, second = p.x> 19.5 && p.x < 31.5;
    return first || second ? 230.0 : 120.0;
  });
  const Volume guide = smoothed(volume);
  const auto thick = thick_places(guide, crossing_points(guide, kLevel, 100'000), kLevel).points;
  ASSERT_FALSE(thick.empty());
  for (const SurfacePoint& point : thick) {
    EXPECT_TRUE(point.position.x < 8 || point.position.x > 29) << point.position.x;
  }
}

TEST(ThickPlaces, AreAllWhereFewCanBeJudged) {
  const Volume ball = make_ball({.size = 12, .noise = 0, .radius = 2});
  auto points = crossing_points(ball, kLevel, 100'000);
  points.resize(std::min<std::size_t>(points.size(), 40));
  const ThickPlaces found = thick_places(ball, points, kLevel);
  EXPECT_EQ(found.points.size(), points.size());
  EXPECT_EQ(found.least, 0);
}

}  // namespace
}  // namespace mesamis
