// SPDX-License-Identifier: Apache-2.0
#include "mesamis/restore/value_variation.h"

#include <gtest/gtest.h>

#include "mesamis/image/gaussian.h"
#include "mesamis/image/grey_values.h"
#include "mesamis/restore/scan_quality.h"
#include "mesamis/restore/thick_places.h"
#include "support/ball_volume.h"
#include "support/sampled_volume.h"

namespace mesamis {
namespace {

constexpr double kLevel = 175;

double variation_of(const Volume& volume) {
  const Volume guide = smoothed(volume);
  const auto points = crossing_points(guide, kLevel, 100'000);
  return measure_variation(volume, thick_places(guide, points, kLevel).points,
                           measure_noise(volume, guide, points, kLevel));
}

/// Blocks of 16 voxels whose values go from 230 - spread to 230 + spread.
Volume blocks(double spread) {
  Volume volume = sampled_volume({110, 30, 30}, {1, 1, 1}, [spread](const Vec3& p) {
    const int block = static_cast<int>(p.x / 22);
    const bool inside = p.x - 22 * block > 3.5 && p.x - 22 * block < 19.5;
    return inside ? 230 + spread * (block - 2) / 2 : 120;
  });
  return gaussian_smoothed(std::move(volume), 0.7);
}

TEST(ValueVariation, IsSmallInOneMaterial) {
  for (const double noise : {0.0, 4.0, 15.0, 30.0}) {
    EXPECT_LT(variation_of(make_ball({.size = 48, .noise = noise, .radius = 15})), 0.05 * 110)
        << noise;
  }
}

TEST(ValueVariation, GrowsWithTheDifferencesBetweenPlaces) {
  EXPECT_LT(variation_of(blocks(0)), 0.02 * 110);
  const double some = variation_of(blocks(20)), more = variation_of(blocks(40));
  // The quartiles of five values a, b, c, d, e are b and d: half of the spread away from c.
  EXPECT_NEAR(some, 20 / 1.349, 2);
  EXPECT_NEAR(more, 40 / 1.349, 4);
}

TEST(ValueVariation, IsNothingWithoutPoints) { EXPECT_EQ(measure_variation(blocks(20), {}, 1), 0); }

}  // namespace
}  // namespace mesamis
