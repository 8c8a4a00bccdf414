// SPDX-License-Identifier: Apache-2.0
#include "mesamis/restore/restore.h"

#include <gtest/gtest.h>

#include <cmath>

#include "mesamis/base/parallel.h"
#include "mesamis/phantom/degrade.h"
#include "mesamis/phantom/phantom.h"
#include "mesamis/restore/deblur.h"
#include "support/ball_volume.h"
#include "support/sampled_volume.h"
#include "support/throws.h"

namespace mesamis {
namespace {

double misfit(const Volume& a, const Volume& b) {
  double sum = 0;
  for (std::size_t n = 0; n < a.samples.size(); ++n) {
    sum += std::pow(a.samples[n] - b.samples[n], 2) / static_cast<double>(a.samples.size());
  }
  return std::sqrt(sum);
}

TEST(Restore, ComesNearerToTheObjectAsItIs) {
  const Volume truth = sample_phantom(make_phantom("fracture"));
  for (const DegradeOptions& faults : {DegradeOptions{.blur = 1, .noise = 4},
                                       {.blur = 1, .noise = 15},
                                       {.blur = 1, .noise = 30},
                                       {.blur = 1, .salt_pepper = 0.02},
                                       {.blur = 1, .speckle = 0.1}}) {
    const Volume scan = degrade(truth, faults);
    const Restored restored = restore(scan, find_half_maximum_level(scan));
    EXPECT_LT(misfit(restored.volume, truth), 0.9 * misfit(scan, truth));
    EXPECT_NEAR(restored.impulses, 0.98 * faults.salt_pepper, 0.001);
  }
}

TEST(Restore, DoesAsItIsTold) {
  const Volume scan = degrade(sample_phantom(make_phantom("sphere")), {.blur = 1, .noise = 10});
  const HalfMaximumLevel object = find_half_maximum_level(scan);
  const Restored left = restore(scan, object, {.noise = 3, .blur = {{0, 0, 0}}});
  EXPECT_TRUE(left.volume.samples == scan.samples);
  EXPECT_EQ(left.noise, 3);
  EXPECT_EQ(left.noise_left, 3);
  for (const double along : left.surface_noise) {  // of means over some 8 voxels
    EXPECT_GT(along, 3 / 4.0);
    EXPECT_LT(along, 3 / 2.0);
  }
  const Restored gentle = restore(scan, object, {.noise = 100, .blur = {{1, 1, 1}}});
  const Restored strong = restore(scan, object, {.noise = 1, .blur = {{1, 1, 1}}});
  EXPECT_LT(gentle.noise_left / gentle.noise, strong.noise_left / strong.noise);
}

TEST(Restore, LeavesAConstantImage) {
  const Volume flat = sampled_volume({12, 10, 9}, {1, 1, 2}, [](const Vec3&) { return 40; });
  EXPECT_EQ(restore(flat, find_half_maximum_level(flat)).volume.samples, flat.samples);
  // Also where it is told of an object that is not there.
  const HalfMaximumLevel object{50, {10, 90, 100}};
  const Restored restored = restore(flat, object, {.noise = 1, .blur = {{1, 1, 1}}});
  for (const float x : restored.volume.samples) EXPECT_NEAR(x, 40, 0.01);
  EXPECT_EQ(restored.impulses, 0);
}

TEST(Restore, TakesAllForNoiseWhereThereIsNoObject) {
  const Volume flat = sampled_volume({30, 30, 30}, {1, 1, 1}, [](const Vec3&) { return 40; });
  const Restored restored = restore(degrade(flat, {.noise = 100}), HalfMaximumLevel{});
  EXPECT_NEAR(restored.noise, 100, 5);
  EXPECT_EQ(restored.noise_left, restored.noise);
  for (const double along : restored.surface_noise) EXPECT_GT(along, 100 / 4.0);
  EXPECT_NEAR(restore(flat, HalfMaximumLevel{}).noise, 0, 1e-9) << "but for round-off";
}

TEST(Restore, ScalesWithTheImage) {
  // Undoing a known blur is linear; units and offset of the values must not matter.
  const Volume scan = degrade(make_ball({.noise = 0}), {.noise = 6});
  Volume scaled = scan;
  for (float& x : scaled.samples) x = 4 * x - 300;
  const HalfMaximumLevel object{175, {120, 230, 1000}}, other{400, {180, 620, 1000}};
  const Volume a = restore(scan, object, {.noise = 6, .blur = {{1, 1, 1}}}).volume;
  const Volume b = restore(scaled, other, {.noise = 24, .blur = {{1, 1, 1}}}).volume;
  for (std::size_t n = 0; n < a.samples.size(); ++n) {
    ASSERT_NEAR(b.samples[n], 4 * a.samples[n] - 300, 0.05);
  }
}

TEST(Restore, LeavesABlurThatSamplesCannotShow) {
  const Volume scan = make_ball({.noise = 3});
  const HalfMaximumLevel object{175, {120, 230, 1000}};
  const Restored restored = restore(scan, object, {.noise = 3, .blur = {{0.35, 0.3, 0.2}}});
  EXPECT_EQ(restored.noise_left, 3);
  EXPECT_EQ(restored.volume.samples, scan.samples) << "a ball has no thin walls either";
}

TEST(Restore, SameBitsForAnyNumberOfThreads) {
  const Volume scan = degrade(make_ball({.noise = 5}), {.salt_pepper = 0.01});
  const HalfMaximumLevel object = find_half_maximum_level(scan);
  const Restored one = with_threads(1, [&] { return restore(scan, object); });
  const Restored three = with_threads(3, [&] { return restore(scan, object); });
  EXPECT_EQ(one.volume.samples, three.volume.samples);
  EXPECT_EQ(one.noise_left, three.noise_left);
}

TEST(Restore, RefusesABlurOutOfRange) {
  const Volume scan = make_ball({});
  const HalfMaximumLevel object = find_half_maximum_level(scan);
  EXPECT_REFUSED(restore(scan, object, {.blur = {{1, kLargestBlur + 0.5, 1}}}),
                 testing::HasSubstr("found 3.5"));
}

TEST(Restore, RemovesImpulsesAsItIsTold) {
  const Volume truth = sample_phantom(make_phantom("sphere"));
  // So few that by itself it takes them for small structures; and many.
  for (const double share : {2e-5, 0.02}) {
    const Volume scan = degrade(truth, {.noise = 4, .salt_pepper = share});
    const HalfMaximumLevel object = find_half_maximum_level(scan);
    const auto restored = [&](std::optional<double> height) {
      return restore(scan, object, {.noise = 4, .blur = {{0, 0, 0}}, .impulse_height = height});
    };
    EXPECT_GT(restored(40).impulses, 0) << share;
    EXPECT_EQ(restored(40).impulse_height, 40);
    EXPECT_EQ(restored(0).impulses, 0) << share;
    EXPECT_TRUE(restored(0).volume.samples == scan.samples);
    const Restored found = restored({});
    EXPECT_EQ(found.impulses > 0, share > 0.01);
    EXPECT_EQ(found.impulse_height > 0, share > 0.01);
    EXPECT_TRUE(restored(found.impulse_height).volume.samples == found.volume.samples);
  }
}

}  // namespace
}  // namespace mesamis
