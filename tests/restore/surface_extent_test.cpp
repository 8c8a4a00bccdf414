// SPDX-License-Identifier: Apache-2.0
#include "mesamis/restore/surface_extent.h"

#include <gtest/gtest.h>

#include <numbers>

#include "mesamis/image/gaussian.h"
#include "support/ball_volume.h"
#include "support/sampled_volume.h"

namespace mesamis {
namespace {

/// Two blocks with a gap between them, or a wall: what is between x = a and b is bright if `wall`.
Volume slab(double a, double b, bool wall) {
  Volume volume = sampled_volume({40, 24, 24}, {0.5, 0.5, 0.5}, [=](const Vec3& p) {
    return (p.x > a && p.x < b) == wall ? 230.0 : 120.0;
  });
  return gaussian_smoothed(std::move(volume), 0.4);
}

TEST(SurfaceExtent, OfABallIsItsAreaAndNothingIsThin) {
  const Volume ball = make_ball({.size = 48, .noise = 0, .radius = 15});
  const SurfaceExtent extent = measure_extent(ball, 175);
  EXPECT_NEAR(extent.area / (4 * std::numbers::pi * 15 * 15), 1, 0.03);
  EXPECT_EQ(extent.thin_share, 0);
}

TEST(SurfaceExtent, ThinWallsAndGapsCountInVoxels) {
  for (const bool wall : {true, false}) {
    EXPECT_EQ(measure_extent(slab(8.1, 8.9, wall), 175).thin_share, 1) << wall;   // 1.6 voxels
    EXPECT_EQ(measure_extent(slab(8.1, 10.1, wall), 175).thin_share, 0) << wall;  // 4 voxels
  }
}

TEST(SurfaceExtent, OfNothingIsNothing) {
  const SurfaceExtent extent = measure_extent(slab(8, 10, true), 300);
  EXPECT_EQ(extent.area, 0);
  EXPECT_EQ(extent.thin_share, 0);
}

}  // namespace
}  // namespace mesamis
