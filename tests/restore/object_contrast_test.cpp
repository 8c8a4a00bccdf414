// SPDX-License-Identifier: Apache-2.0
#include "mesamis/restore/object_contrast.h"

#include <gtest/gtest.h>

#include "support/ball_volume.h"
#include "support/sampled_volume.h"

namespace mesamis {
namespace {

/// Background 10 below z = 5 mm, object 90 above it, in slices 0.5 mm apart.
Volume two_halves() {
  return sampled_volume({20, 20, 40}, {1, 1, 0.5},
                        [](const Vec3& p) { return p.z < 9.75 ? 10 : 90; });
}

TEST(MeasureContrast, IsThatOfTwoHalves) {
  const Volume volume = two_halves();
  const auto contrast = measure_contrast(volume, volume, crossing_points(volume, 50, 100'000), 50);
  ASSERT_TRUE(contrast);
  EXPECT_EQ(contrast->background, 10);
  EXPECT_EQ(contrast->object, 90);
  EXPECT_EQ(contrast->half_maximum(), 50);
  EXPECT_EQ(contrast->difference(), 80);
  EXPECT_EQ(contrast->samples, 2u * 400u);
}

TEST(MeasureContrast, IsNotChangedByANarrowGap) {
  // A dark gap one voxel wide beside the surface: its points do not reach 1.5 voxels.
  Volume volume = make_ball({.noise = 0});
  const auto before = measure_contrast(volume, volume, crossing_points(volume, 175, 100'000), 175);
  for (Index k = 0; k < 40; ++k) {
    for (Index j = 0; j < 40; ++j) volume.samples[volume.offset(20, j, k)] = 120;
  }
  const auto after = measure_contrast(volume, volume, crossing_points(volume, 175, 100'000), 175);
  ASSERT_TRUE(before && after);
  EXPECT_NEAR(after->background, before->background, 0.02 * before->difference());
  EXPECT_NEAR(after->object, before->object, 0.02 * before->difference());
}

TEST(MeasureContrast, IsNothingWithoutPoints) {
  const Volume volume = make_ball({});
  EXPECT_FALSE(measure_contrast(volume, volume, {}, 175));
}

TEST(PlaceAlongNormal, IsSoManyVoxelsAwayOnItsSide) {
  const Volume volume = two_halves();
  const SurfacePoint point{{9, 9, 9.5}, {0, 0, -1}};
  const auto outside = place_along_normal(volume, point, 2.5, 50);
  const auto inside = place_along_normal(volume, point, -2.5, 50);
  ASSERT_TRUE(outside && inside);
  EXPECT_LT(norm(*outside - Vec3{9, 9, 9.5 - 2.5 * 0.5}), 1e-12);
  EXPECT_LT(norm(*inside - Vec3{9, 9, 9.5 + 2.5 * 0.5}), 1e-12);
}

TEST(PlaceAlongNormal, EndsAtTheOtherSideAndAtTheBorder) {
  const Volume volume = two_halves();
  EXPECT_FALSE(place_along_normal(volume, {{9, 9, 9.5}, {0, 0, 1}}, 1.5, 50));   // into the object
  EXPECT_FALSE(place_along_normal(volume, {{0.5, 9, 5}, {-1, 0, 0}}, 1.5, 50));  // out of the image
}

}  // namespace
}  // namespace mesamis
