// SPDX-License-Identifier: Apache-2.0
#include "mesamis/restore/tissue_threshold.h"

#include <gtest/gtest.h>

#include "mesamis/restore/half_maximum_level.h"
#include "support/ball_volume.h"

namespace mesamis {
namespace {

TEST(TissueThreshold, IsNotNeededForTwoClasses) {
  for (const double noise : {0.5, 4.0, 15.0, 30.0}) {
    const Volume volume = make_ball({.background = 120, .object = 230, .noise = noise});
    const HalfMaximumLevel object = find_half_maximum_level(volume);
    EXPECT_FALSE(find_tissue_threshold(volume, object.contrast, object.level, noise)) << noise;
  }
}

TEST(TissueThreshold, IsNotNeededForASmallObjectInADarkImage) {
  const Volume volume = make_ball({.background = 5, .object = 90, .noise = 2, .radius = 6});
  const HalfMaximumLevel object = find_half_maximum_level(volume);
  EXPECT_FALSE(find_tissue_threshold(volume, object.contrast, object.level, 2));
}

TEST(TissueThreshold, IsTheUpperEndOfTheTissueAroundBone) {
  for (const double noise : {5.0, 20.0, 40.0}) {
    const Volume volume =
        make_ball({.background = 40, .object = 900, .noise = noise, .air = -1000});
    const HalfMaximumLevel object = find_half_maximum_level(volume);
    const auto threshold = find_tissue_threshold(volume, object.contrast, object.level, noise);
    ASSERT_TRUE(threshold) << noise;
    EXPECT_GE(*threshold, 40 - 0.05 * 860);
    EXPECT_LE(*threshold, (40 + object.level) / 2 + 0.05 * 860);
    EXPECT_LE(*threshold, object.level - 2.5 * noise);
  }
}

TEST(TissueThreshold, IsNotNeededWithoutContrast) {
  const Volume volume = make_ball({.background = 40, .object = 900, .air = -1000});
  EXPECT_FALSE(find_tissue_threshold(volume, {900, 900, 0}, 470, 4));
}

}  // namespace
}  // namespace mesamis
