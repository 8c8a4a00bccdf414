// SPDX-License-Identifier: Apache-2.0
#include "mesamis/restore/edge_level.h"

#include <gtest/gtest.h>

#include <cmath>

#include "mesamis/restore/object_contrast.h"
#include "support/ball_volume.h"
#include "support/sampled_volume.h"

namespace mesamis {
namespace {

constexpr double kLevel = 175;

TEST(EdgeLevel, IsMidwayToAShellTooThinToBeSeen) {
  // 120, then a shell of 230 that is a voxel and a half thick, then 200; hardly blurred.
  const Vec3 normal = (1 / norm(Vec3{1, 0.3, 0.2})) * Vec3{1, 0.3, 0.2};
  const auto depth = [&normal](const Vec3& p) { return dot(normal, p) - 18; };
  const auto step = [](double t) { return 0.5 * std::erfc(-t / (0.5 * std::sqrt(2))); };
  const Volume scan = sampled_volume({30, 30, 30}, {1, 1, 1}, [&](const Vec3& p) {
    return 120 + 110 * step(depth(p)) - 30 * step(depth(p) - 1.5);
  });
  std::vector<SurfacePoint> points;
  for (double y = 8; y < 20; y += 0.37) {
    for (double z = 8; z < 20; z += 0.41) {
      const Vec3 seen{10, y, z};
      points.push_back({seen - (depth(seen) - 0.3) * normal, -1.0 * normal});  // 0.3 too deep
    }
  }
  const auto edge = measure_edge(scan, points);
  ASSERT_TRUE(edge);
  EXPECT_NEAR(edge->level(), kLevel, 4);
  const auto contrast = measure_contrast(scan, scan, points, kLevel);
  ASSERT_TRUE(contrast);
  EXPECT_LT(contrast->half_maximum(), kLevel - 5);
}

TEST(EdgeLevel, IsTheHalfMaximumWithoutAShell) {
  const Volume scan = make_ball({.noise = 0, .radius = 14});
  const auto edge = measure_edge(scan, crossing_points(scan, 170, 100'000));
  ASSERT_TRUE(edge);
  // sigma^2 / radius: the blur moves the half maximum of a ball inwards by that.
  EXPECT_NEAR(edge->level(), kLevel, 110 * 0.05);
}

TEST(EdgeLevel, IsNothingWithoutPointsOrNormals) {
  const Volume scan = make_ball({.noise = 0});
  EXPECT_FALSE(measure_edge(scan, {}));
  auto points = crossing_points(scan, kLevel, 100'000);
  for (SurfacePoint& point : points) point.normal = {};
  EXPECT_FALSE(measure_edge(scan, points));
}

TEST(EdgeLevel, IsNothingWhereTheImageIsNoEdge) {
  const Volume ramp = sampled_volume({30, 30, 30}, {1, 1, 1},
                                     [](const Vec3& p) { return 100 + std::sin(2 * p.x) * 50; });
  EXPECT_FALSE(measure_edge(ramp, crossing_points(ramp, 100, 100'000)));
}

}  // namespace
}  // namespace mesamis
