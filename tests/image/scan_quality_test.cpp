// SPDX-License-Identifier: Apache-2.0
#include "mesamis/image/scan_quality.h"

#include <gtest/gtest.h>

#include "mesamis/image/degrade.h"
#include "mesamis/image/grey_values.h"
#include "mesamis/image/phantom.h"
#include "mesamis/image/restore.h"
#include "support/sampled_volume.h"

namespace mesamis {
namespace {

constexpr double kLevel = 175;

Volume scan_of(const char* phantom, const DegradeOptions& faults) {
  return degrade(sample_phantom(make_phantom(phantom)), faults);
}

TEST(MeasureNoise, FindsWhatWasAdded) {
  for (const char* phantom : {"sphere", "fracture"}) {
    for (const double noise : {5.0, 15.0, 30.0}) {
      const Volume scan = scan_of(phantom, {.blur = 1, .noise = noise});
      const Volume guide = smoothed(scan);
      const auto points = crossing_points(guide, kLevel, 100'000);
      EXPECT_NEAR(measure_noise(scan, guide, points, kLevel), noise, 1 + 0.05 * noise) << phantom;
    }
  }
}

TEST(MeasureNoise, IsNothingWithoutPlaces) {
  const Volume scan = scan_of("sphere", {});
  EXPECT_EQ(measure_noise(scan, scan, {}, kLevel), 0);
}

TEST(MeasureBlur, FindsTheBlurOfEachAxis) {
  const double voxel = 1.0 / 12;  // variance of a voxel's own extent
  for (const double noise : {0.0, 15.0, 30.0}) {
    for (const double blur : {0.6, 1.0, 1.5}) {
      const Volume scan = scan_of("sphere", {.blur = blur, .noise = noise});
      const auto points = crossing_points(smoothed(smoothed(scan)), kLevel, 100'000);
      for (const double found : measure_blur(scan, points, noise)) {
        // Noise makes it fall short, never the other way: too much undone is worse.
        const double truth = std::sqrt(blur * blur + voxel);
        EXPECT_LT(found, truth + 0.15) << blur << " " << noise;
        EXPECT_GT(found, truth * (0.9 - noise / 300)) << blur << " " << noise;
      }
    }
  }
}

TEST(MeasureBlur, TellsAxesApart) {
  // Layers twice as thick: half as many voxels of blur across them, seen in mm.
  const Volume fine = scan_of("sphere", {.blur = 1.4});
  Volume scan = subsample(fine, {1, 1, 2});
  const auto points = crossing_points(smoothed(smoothed(scan)), kLevel, 100'000);
  const auto blur = measure_blur(scan, points, 0);
  EXPECT_NEAR(blur[0], 1.4, 0.15);
  EXPECT_NEAR(blur[1], 1.4, 0.15);
  EXPECT_NEAR(blur[2], 0.7, 0.15);
}

TEST(MeasureBlur, IsNothingWithoutPoints) {
  EXPECT_EQ(measure_blur(scan_of("sphere", {}), {}, 0), (std::array<double, 3>{}));
}

TEST(MeasureLevel, IsMidwayThoughAThinShellLeavesNoRoomForItsSide) {
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
  const auto level = measure_level(scan, points);
  ASSERT_TRUE(level);
  EXPECT_NEAR(*level, kLevel, 4);
  const auto sides = measure_sides(scan, scan, points, kLevel);
  ASSERT_TRUE(sides);
  EXPECT_LT(sides->middle(), kLevel - 5);
  EXPECT_FALSE(measure_level(scan, {}));
}

TEST(RemoveImpulses, FindsThemAndKeepsALineOneVoxelThin) {
  Volume volume = sampled_volume({12, 12, 12}, {1, 1, 1}, [](const Vec3& p) {
    return p.x == 4 && p.y == 5 ? 100 : 10 + 0.1 * p.y;
  });
  const Volume before = volume;
  volume.samples[volume.offset(8, 8, 8)] = 255;
  volume.samples[volume.offset(0, 0, 0)] = -50;
  EXPECT_EQ(remove_impulses(volume, 20), 4u);  // the line's ends at the border are two
  for (std::size_t n = 0; n < volume.samples.size(); ++n) {
    const bool is_end = before.samples[n] == 100 && (n < 144 || n >= 11 * 144);
    if (is_end) continue;
    EXPECT_NEAR(volume.samples[n], before.samples[n], 0.11);
  }
}

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
    const Restored restored = restore(scan, find_object(scan));
    EXPECT_LT(misfit(restored.volume, truth), 0.9 * misfit(scan, truth));
    EXPECT_NEAR(restored.impulses, 0.98 * faults.salt_pepper, 0.001);
  }
}

TEST(Restore, DoesAsItIsTold) {
  const Volume scan = scan_of("sphere", {.blur = 1, .noise = 10});
  const ObjectEdges object = find_object(scan);
  const Restored left = restore(scan, object, {.noise = 3, .blur = {{0, 0, 0}}});
  EXPECT_TRUE(left.volume.samples == scan.samples);
  EXPECT_EQ(left.noise, 3);
  const Restored gentle = restore(scan, object, {.noise = 100, .blur = {{1, 1, 1}}});
  const Restored strong = restore(scan, object, {.noise = 1, .blur = {{1, 1, 1}}});
  EXPECT_LT(gentle.noise_left, strong.noise_left);
}

TEST(FindObject, IsFoundThoughMostOfTheImageIsNoise) {
  // Two hundredths of the voxels: the best split of all values is one of the noise.
  Volume scan = sampled_volume({96, 96, 96}, {1, 1, 1}, [](const Vec3& p) {
    return norm(p - Vec3{40, 50, 45}) < 12 ? 230 : 120;
  });
  scan = degrade(scan, {.blur = 1, .noise = 30});
  EXPECT_NEAR(find_object(scan).level, kLevel, 6);
}

}  // namespace
}  // namespace mesamis
