// SPDX-License-Identifier: Apache-2.0
#include "mesamis/object/padding.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "object/object_scenes.h"
#include "support/ball_volume.h"
#include "support/sampled_volume.h"
#include "support/throws.h"

namespace mesamis {
namespace {

using testing::Each;
using testing::ElementsAre;
using testing::HasSubstr;

const VoxelGrid kGrid = grid_of({64, 60, 10}, {1, 1, 2});

/// The field of view: a cylinder.
bool is_seen(const Vec3& p) { return std::hypot(p.x - 31, p.y - 30) < 28; }

/// A body of 40 in air of -1000, both with noise.
Volume trunk(const VoxelGrid& grid = kGrid) {
  const VoxelMask body = mask_where(
      grid, [](const Vec3& p) { return std::hypot((p.x - 31) / 22, (p.y - 30) / 15) < 1; });
  Volume volume = volume_of(grid, body, 40, -1000);
  add_noise(volume, 15);
  return volume;
}

/// The same with padding around the field of view.
Volume ct(float padding) {
  return filled(trunk(), complement(mask_where(kGrid, is_seen)), padding);
}

/// Something like MR: 600 in air of about 20, which is never negative.
Volume mr() {
  Volume volume = trunk();
  volume.modality = "MR";
  for (float& x : volume.samples) x = x > -400 ? x + 560 : std::abs(x + 1000) + 1;
  return volume;
}

TEST(Padding, OfARoundFieldOfViewIsFound) {
  for (const float value : {-3024.F, -2048.F, -2000.F}) {
    const auto padding = find_padding(ct(value));
    ASSERT_TRUE(padding) << value;
    EXPECT_EQ(padding->value, value);
    EXPECT_EQ(padding->mask, complement(mask_where(kGrid, is_seen)));
    EXPECT_EQ(padding->voxels, count_marked(padding->mask));
  }
}

TEST(Padding, HoldsWhatInterpolationMadeOfIt) {
  Volume volume = ct(-3024);
  const std::size_t between = volume.offset(31, 2, 5);  // beside padding
  ASSERT_EQ(volume.samples[volume.offset(31, 1, 5)], -3024);
  volume.samples[between] = -1400;
  EXPECT_EQ(find_padding(volume)->mask[between], 1);
}

TEST(Padding, OfZeroInMrIsFound) {
  const Volume volume = filled(mr(), complement(mask_where(kGrid, is_seen)), 0);
  const auto padding = find_padding(volume);
  ASSERT_TRUE(padding);
  EXPECT_EQ(padding->value, 0);
  EXPECT_EQ(padding->mask, complement(mask_where(kGrid, is_seen)));
}

TEST(Padding, OfATurnedBoxIsFound) {
  const auto is_in_box = [](const Vec3& p) {
    const double x = p.x - 31, y = p.y - 30;
    return std::abs(0.9 * x + 0.436 * y) < 24 && std::abs(-0.436 * x + 0.9 * y) < 22;
  };
  const VoxelMask outside = complement(mask_where(kGrid, is_in_box));
  const auto padding = find_padding(filled(mr(), outside, 0));
  ASSERT_TRUE(padding);
  EXPECT_EQ(padding->mask, outside);
}

TEST(Padding, IsNotTheAirOfAScan) {
  EXPECT_FALSE(find_padding(trunk()));
  EXPECT_FALSE(find_padding(mr()));
}

/// A scanner that knows nothing below -1024 makes an even background, and fills up with it.
TEST(Padding, IsNotClippedAir) {
  EXPECT_FALSE(find_padding(ct(-1024)));
  Volume volume = trunk();
  for (float& x : volume.samples) x = x < -900 ? -1024 : x;
  EXPECT_FALSE(find_padding(volume));
}

TEST(Padding, IsNotTheBackgroundOfAPhantom) {
  for (const double blur : {0.3, 0.7, 1.0, 2.0}) {
    BallVolume ball{.background = 0, .object = 200, .noise = 0, .blur = blur};
    Volume volume = make_ball(ball);
    EXPECT_FALSE(find_padding(volume)) << blur;
    for (float& x : volume.samples) x = std::round(x);
    EXPECT_FALSE(find_padding(volume)) << blur << ", rounded";
  }
}

/// Voxels at the surface hold a part of the object.
TEST(Padding, IsNotTheBackgroundOfAPhantomWithPartialVolume) {
  const Volume volume = sampled_volume({40, 40, 40}, {1, 1, 1}, [](const Vec3& p) {
    return 200 * std::clamp(12.5 - norm(p - Vec3{19.5, 19.5, 19.5}), 0.0, 1.0);
  });
  EXPECT_FALSE(find_padding(volume));
}

/// A brain without its skull: grey values that end at an even zero.
TEST(Padding, IsNotWhatAMaskTookAway) {
  Volume volume = sampled_volume({50, 44, 40}, {1, 1, 1}, [](const Vec3& p) {
    return 500 + 100 * std::sin(p.x / 3) * std::cos(p.y / 4);
  });
  add_noise(volume, 30);
  const VoxelMask outside = mask_where(volume, [](const Vec3& p) {
    const Vec3 q = p - Vec3{25, 22, 20};
    return norm(Vec3{q.x / 20, q.y / 17, q.z / 15}) > 1;
  });
  EXPECT_FALSE(find_padding(filled(volume, outside, 0)));
}

/// An object of one value, or of few, that fills a part of an even background: a mask, a cylinder.
/// What it leaves out is convex, as around a field of view.
TEST(Padding, IsNotTheBackgroundOfAnObjectOfFewValues) {
  const auto scene = [](double rim, double core) {
    return sampled_volume({40, 36, 30}, {1, 1, 1}, [=](const Vec3& p) {
      const Vec3 q = p - Vec3{20, 18, 15};
      const double r = norm(Vec3{q.x / 10, q.y / 9, q.z / 8});
      return r < 0.5 ? core : r < 1 ? rim : 0;
    });
  };
  for (const auto& [rim, core] : {std::pair{1.0, 1.0},
                                  {255.0, 255.0},
                                  {1.0, 2.0},
                                  {2.0, 1.0},
                                  {1.0, 10.0},
                                  {100.0, 3000.0}}) {
    EXPECT_FALSE(find_padding(scene(rim, core))) << rim << " around " << core;
  }
  for (const double noise : {0.02, 0.5, 2.0}) {
    for (const double core : {100.0, 200.0}) {
      Volume volume = scene(100, core);
      Volume noisy = volume;
      add_noise(noisy, noise);
      for (std::size_t n = 0; n < volume.samples.size(); ++n) {
        if (volume.samples[n] != 0) volume.samples[n] = noisy.samples[n];
      }
      EXPECT_FALSE(find_padding(volume)) << core << ", noise " << noise;
      for (float& x : volume.samples) x = std::round(x);
      EXPECT_FALSE(find_padding(volume)) << core << ", noise " << noise << ", rounded";
    }
  }
}

/// A sample that is larger than the field of view: its texture is cut through.
TEST(Padding, AroundATextureThatIsCutThroughIsFound) {
  Volume volume = sampled_volume(kGrid.size, kGrid.spacing, [](const Vec3& p) {
    const double rock = std::sin(p.x / 2) * std::cos(p.y / 2.5) * std::cos(p.z / 3);
    return rock > 0 ? 30000 : 12000;
  });
  add_noise(volume, 900);
  const VoxelMask outside = complement(mask_where(kGrid, is_seen));
  const auto padding = find_padding(filled(volume, outside, 0));
  ASSERT_TRUE(padding);
  EXPECT_EQ(padding->mask, outside);
}

TEST(Padding, IsWhatTheRuleSays) {
  const Volume scan = ct(-3024);
  EXPECT_FALSE(find_padding(scan, parse_padding("none")));
  EXPECT_EQ(find_padding(scan, parse_padding("auto"))->mask, find_padding(scan)->mask);
  const auto given = find_padding(scan, parse_padding("-3024"));
  ASSERT_TRUE(given);
  EXPECT_EQ(given->mask, complement(mask_where(kGrid, is_seen)));
  EXPECT_EQ(given->value, -3024);
  EXPECT_FALSE(find_padding(scan, parse_padding("17")));
  for (const char* text : {"", "Auto", "1e", "nan", "inf", "1 2"}) {
    EXPECT_REFUSED(parse_padding(text), HasSubstr("expected auto, none or a number")) << text;
  }
}

/// A cross is no field of view.
TEST(Padding, LeavesSomethingConvex) {
  const VoxelMask outside = mask_where(
      kGrid, [](const Vec3& p) { return std::abs(p.x - 31) > 9 && std::abs(p.y - 30) > 9; });
  EXPECT_FALSE(find_padding(filled(mr(), outside, 0)));
}

TEST(Padding, IsNotTheWholeScanNorNothing) {
  Volume volume = trunk();
  std::fill(volume.samples.begin(), volume.samples.end(), -3024.F);
  EXPECT_FALSE(find_padding(volume));
  EXPECT_FALSE(find_padding(VolumeView{}));
}

TEST(SamplesOutside, AreThoseNotMarkedInTheirOrder) {
  Volume volume;
  volume.size = {4, 1, 1};
  volume.samples = {1, 2, 3, 4};
  EXPECT_THAT(samples_outside(volume, VoxelMask{0, 1, 0, 1}), ElementsAre(1, 3));
  EXPECT_REFUSED(samples_outside(volume, VoxelMask(3)), HasSubstr("mask"));
}

TEST(Filled, SetsWhatIsMarked) {
  Volume volume;
  volume.size = {4, 1, 1};
  volume.samples = {1, 2, 3, 4};
  EXPECT_THAT(filled(volume, VoxelMask{0, 1, 0, 1}, -7).samples, ElementsAre(1, -7, 3, -7));
  EXPECT_REFUSED(filled(volume, VoxelMask(3), 0), HasSubstr("mask"));
}

TEST(ShareAtBorder, IsTheShareOfCrossingsBesideThePadding) {
  Volume volume;
  volume.size = {4, 2, 2};
  for (int row = 0; row < 4; ++row) {
    for (const float x : {-3024.F, 100.F, 100.F, -100.F}) volume.samples.push_back(x);
  }
  VoxelMask mask(16);
  for (std::size_t n = 0; n < 16; ++n) mask[n] = n % 4 == 0;
  EXPECT_EQ(share_at_border(volume, mask, 0), 0.5);
  EXPECT_EQ(share_at_border(volume, mask, -500), 1);
  EXPECT_EQ(share_at_border(volume, mask, 500), 0);
  EXPECT_REFUSED(share_at_border(volume, VoxelMask(3), 0), HasSubstr("mask"));
}

}  // namespace
}  // namespace mesamis
