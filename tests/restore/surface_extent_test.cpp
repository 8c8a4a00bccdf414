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
    EXPECT_EQ(measure_extent(slab(8.1, 8.9, wall), 175).thin_share, 1) << wall;   // one sample
    EXPECT_EQ(measure_extent(slab(8.1, 10.1, wall), 175).thin_share, 0) << wall;  // four samples
  }
}

TEST(SurfaceExtent, CountsByAreaWhateverTheVoxels) {
  // A thin wall across x and a thick block across z, with faces of 24 x 40 mm and 24 x 40 mm.
  const Volume volume = gaussian_smoothed(sampled_volume({40, 48, 20}, {0.5, 0.5, 2},
                                                         [](const Vec3& p) {
                                                           const bool wall = p.x > 2.1 && p.x < 2.9;
                                                           const bool block =
                                                               p.x > 6.1 && p.z > 12.2 && p.z < 27;
                                                           return wall || block ? 230.0 : 120.0;
                                                         }),
                                          0.4);
  // Thin: 2 x 23.5 x 38; else: 2 x 23.5 x 13.4 and a side of 23.5 x 14.8 mm.
  const double thin = 2 * 38, thick = 2 * 13.4 + 14.8;
  EXPECT_NEAR(measure_extent(volume, 175).thin_share, thin / (thin + thick), 0.04);
}

TEST(SurfaceExtent, OfNothingIsNothing) {
  const SurfaceExtent extent = measure_extent(slab(8, 10, true), 300);
  EXPECT_EQ(extent.area, 0);
  EXPECT_EQ(extent.thin_share, 0);
}

}  // namespace
}  // namespace mesamis
