// SPDX-License-Identifier: Apache-2.0
#include "mesamis/object/keep.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "mesamis/base/parallel.h"
#include "mesamis/object/voxel_distance.h"
#include "object/object_scenes.h"
#include "support/throws.h"

namespace mesamis {
namespace {

using testing::Each;
using testing::HasSubstr;

const VoxelGrid kGrid = grid_of({24, 20, 16}, {0.8, 1, 1.25});

VoxelMask ball(double radius) {
  return mask_where(kGrid, [&](const Vec3& p) { return norm(p - Vec3{9, 9, 9}) < radius; });
}

Volume noise() {
  Volume volume = volume_of(kGrid, ball(100), 100, 0);
  add_noise(volume, 50);
  return volume;
}

TEST(KeptTo, ChangesNothingWithinTheMargin) {
  const Volume volume = noise();
  const VoxelMask mask = ball(4);
  const auto distance = distance_to_mask(mask, kGrid);
  const Volume kept = kept_to(volume, mask, {.margin = 2, .background = 80});
  for (std::size_t n = 0; n < mask.size(); ++n) {
    if (distance[n] <= 2) {
      ASSERT_EQ(kept.samples[n], volume.samples[n]);
    }
  }
}

TEST(KeptTo, LeavesNothingBrightTwoVoxelsBeyondIt) {
  const Volume volume = noise();
  const VoxelMask mask = ball(4);
  const auto distance = distance_to_mask(mask, kGrid);
  const Volume kept = kept_to(volume, mask, {.margin = 2, .background = 80});
  for (std::size_t n = 0; n < mask.size(); ++n) {
    if (distance[n] >= 2 + 2 * kGrid.voxel_size()) {
      ASSERT_EQ(kept.samples[n], std::min(volume.samples[n], 80.F));
    }
    ASSERT_LE(kept.samples[n], volume.samples[n]);
    ASSERT_GE(kept.samples[n], std::min(volume.samples[n], 80.F));
  }
}

/// In an even image the new values fall with the distance, and one step along a fine line is small.
TEST(KeptTo, FadesSmoothly) {
  const VoxelGrid line = grid_of({400, 2, 2}, {0.01, 10, 10});  // a voxel of 1 mm in its mean
  const VoxelMask mask = mask_where(line, [](const Vec3& p) { return p.x < 0.5; });
  const Volume volume = volume_of(line, mask, 100, 100);
  const Volume kept = kept_to(volume, mask, {.margin = 1, .background = 0});
  float before = 100;
  for (Index i = 0; i < 400; ++i) {
    const float here = kept.at(i, 0, 0);
    EXPECT_LE(here, before);
    EXPECT_GT(here, before - 0.8F);
    before = here;
  }
  EXPECT_NEAR(kept.at(249, 0, 0), 50, 1);
  EXPECT_EQ(before, 0);
}

TEST(KeptTo, DoesNotTouchAnObjectThatEndsWithinTheMargin) {
  const Volume volume = volume_of(kGrid, ball(5), 500, 20);
  EXPECT_EQ(kept_to(volume, ball(4), {.margin = 2, .background = 20}).samples, volume.samples);
}

TEST(KeptTo, LeavesWhatIsDarkerThanTheBackground) {
  const Volume volume = volume_of(kGrid, ball(100), 10, 10);
  EXPECT_EQ(kept_to(volume, ball(3), {.margin = 1, .background = 20}).samples, volume.samples);
}

TEST(KeptTo, RefusesWhatMakesNoSense) {
  const Volume volume = noise();
  EXPECT_REFUSED(kept_to(volume, VoxelMask(3), {}), HasSubstr("mask"));
  EXPECT_REFUSED(kept_to(volume, VoxelMask(kGrid.voxel_count(), 0), {}), HasSubstr("mask"));
  EXPECT_REFUSED(kept_to(volume, ball(3), {.margin = -1}), HasSubstr("margin"));
  EXPECT_REFUSED(kept_to(volume, ball(3), {.margin = std::nan("")}), HasSubstr("margin"));
  EXPECT_REFUSED(kept_to(volume, ball(3), {.background = INFINITY}), HasSubstr("background"));
}

TEST(KeptTo, HasTheSameBitsForAnyNumberOfThreads) {
  const Volume volume = noise();
  const auto keep = [&] { return kept_to(volume, ball(3), {.background = 50}).samples; };
  EXPECT_EQ(with_threads(2, keep), with_threads(1, keep));
}

TEST(Without, TakesOutWhatIsDeepInTheMask) {
  const Volume volume = noise();
  const VoxelMask mask = ball(6);
  const auto depth = distance_to_mask(complement(mask), kGrid);
  const Volume rest = without(volume, mask, {.margin = 1, .background = 80});
  for (std::size_t n = 0; n < mask.size(); ++n) {
    if (depth[n] <= 1) {
      ASSERT_EQ(rest.samples[n], volume.samples[n]);
    }
    if (depth[n] >= 1 + 2 * kGrid.voxel_size()) {
      ASSERT_EQ(rest.samples[n], std::min(volume.samples[n], 80.F));
    }
  }
}

TEST(Without, AnEmptyMaskChangesNothingAndAFullOneIsRefused) {
  const Volume volume = noise();
  const std::size_t voxels = kGrid.voxel_count();
  EXPECT_EQ(without(volume, VoxelMask(voxels, 0), {}).samples, volume.samples);
  EXPECT_REFUSED(without(volume, VoxelMask(voxels, 1), {}), HasSubstr("mask"));
  EXPECT_REFUSED(without(volume, VoxelMask(3), {}), HasSubstr("mask"));
}

}  // namespace
}  // namespace mesamis
