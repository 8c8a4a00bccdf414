// SPDX-License-Identifier: Apache-2.0
#include "mesamis/restore/scan_quality.h"

#include <gtest/gtest.h>

#include <cmath>

#include "mesamis/image/grey_values.h"
#include "mesamis/phantom/degrade.h"
#include "mesamis/phantom/phantom.h"
#include "support/ball_volume.h"
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

TEST(MeasureNoiseCorrelation, TellsWhatNeighboursShare) {
  Volume scan = make_ball({.size = 64, .noise = 15, .radius = 22});
  const Volume guide = smoothed(scan);
  const auto points = crossing_points(guide, kLevel, 100'000);
  for (const double white : measure_noise_correlation(scan, guide, points, kLevel)) {
    EXPECT_NEAR(white, 0, 0.1);
  }
  // Noise that is the mean of two neighbours along x has half in common with the next.
  const Volume noise = degrade(scan, {.noise = 30, .seed = 5});
  for (std::size_t n = scan.samples.size(); n-- > 1;) {
    scan.samples[n] +=
        (noise.samples[n] + noise.samples[n - 1] - scan.samples[n] - scan.samples[n - 1]) / 2;
  }
  const auto shared = measure_noise_correlation(scan, guide, points, kLevel);
  EXPECT_NEAR(shared[0], 0.5 * 450 / (450 + 225), 0.1);
  EXPECT_NEAR(shared[1], 0, 0.1);
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
      for (const double found : measure_blur(scan, points)) {
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
  const auto blur = measure_blur(scan, points);
  EXPECT_NEAR(blur[0], 1.4, 0.15);
  EXPECT_NEAR(blur[1], 1.4, 0.15);
  EXPECT_NEAR(blur[2], 0.7, 0.15);
}

TEST(MeasureBlur, OfThickSlicesIsNotThatOfThePixels) {
  const Volume scan = subsample(scan_of("sphere", {.blur = 1.8}), {1, 1, 3});
  const auto points = crossing_points(smoothed(scan), kLevel, 100'000);
  const auto blur = measure_blur(scan, points);
  EXPECT_NEAR(blur[0], 1.8, 0.15);
  EXPECT_EQ(blur[0], blur[1]) << "one plane";
  EXPECT_NEAR(blur[2], 0.6, 0.08);
}

TEST(MeasureBlur, IsThatOfTheOthersWhereNoEdgeTells) {
  const Volume rod = sampled_volume({32, 32, 20}, {1, 1, 2}, [](const Vec3& p) {
    const double d = 9 - std::hypot(p.x - 15.7, p.y - 15.4);
    return 120 + 110 * 0.5 * std::erfc(-d / std::sqrt(2.0) / 1.3);
  });
  const auto blur = measure_blur(rod, crossing_points(rod, kLevel, 100'000));
  EXPECT_NEAR(blur[0], 1.3, 0.1);
  EXPECT_NEAR(blur[2], 1.3 / 2, 0.05) << "as many mm";
}

TEST(MeasureBlur, IsNothingWithoutPoints) {
  EXPECT_EQ(measure_blur(scan_of("sphere", {}), {}), (std::array<double, 3>{}));
}

}  // namespace
}  // namespace mesamis
