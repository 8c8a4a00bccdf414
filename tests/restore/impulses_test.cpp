// SPDX-License-Identifier: Apache-2.0
#include "mesamis/restore/impulses.h"

#include <gtest/gtest.h>

#include "mesamis/base/parallel.h"
#include "mesamis/phantom/degrade.h"
#include "support/ball_volume.h"
#include "support/sampled_volume.h"

namespace mesamis {
namespace {

TEST(RemoveImpulses, FindsThemAndKeepsALineOneVoxelThin) {
  Volume volume = sampled_volume({12, 12, 12}, {1, 1, 1}, [](const Vec3& p) {
    return p.x == 4 && p.y == 5 ? 100 : 10 + 0.1 * p.y;
  });
  const Volume before = volume;
  volume.samples[volume.offset(8, 8, 8)] = 255;
  volume.samples[volume.offset(0, 0, 0)] = -50;
  const WithoutImpulses clean = remove_impulses(volume, 20);
  EXPECT_EQ(clean.replaced, 4u);  // the line's ends at the border are two
  for (std::size_t n = 0; n < volume.samples.size(); ++n) {
    const bool is_end = before.samples[n] == 100 && (n < 144 || n >= 11 * 144);
    if (is_end) continue;
    EXPECT_NEAR(clean.volume.samples[n], before.samples[n], 0.11);
  }
}

TEST(RemoveImpulses, FindsTheShareThatWasAdded) {
  const Volume truth = make_ball({.noise = 3});
  const Volume scan = degrade(truth, {.salt_pepper = 0.02});
  const WithoutImpulses clean = remove_impulses(scan, 40);
  const auto voxels = static_cast<double>(scan.samples.size());
  EXPECT_NEAR(static_cast<double>(clean.replaced) / voxels, 0.02, 0.002);
}

TEST(RemoveImpulses, LeavesFewAsTheyAre) {
  Volume volume = sampled_volume({12, 12, 12}, {1, 1, 1}, [](const Vec3&) { return 10; });
  volume.samples[volume.offset(8, 8, 8)] = 255;
  const WithoutImpulses kept = remove_impulses(volume, 20, 2.0 / 1728);
  EXPECT_EQ(kept.replaced, 0u);
  EXPECT_EQ(kept.volume.samples, volume.samples);
  EXPECT_EQ(remove_impulses(volume, 20, 1.0 / 1728).replaced, 1u);
}

TEST(RemoveImpulses, SameBitsForAnyNumberOfThreads) {
  const Volume scan = degrade(make_ball({.noise = 3}), {.salt_pepper = 0.05});
  const auto one = with_threads(1, [&] { return remove_impulses(scan, 40); });
  const auto three = with_threads(3, [&] { return remove_impulses(scan, 40); });
  EXPECT_EQ(one.volume.samples, three.volume.samples);
}

}  // namespace
}  // namespace mesamis
