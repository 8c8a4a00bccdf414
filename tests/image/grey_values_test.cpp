// SPDX-License-Identifier: Apache-2.0
#include "mesamis/image/grey_values.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <utility>
#include <vector>

#include "mesamis/base/error.h"
#include "support/ball_volume.h"
#include "support/sampled_volume.h"

namespace mesamis {
namespace {

Volume ramp(double low, double high) {
  Volume volume;
  volume.size = {100, 10, 10};
  for (int n = 0; n < 10'000; ++n) {
    volume.samples.push_back(static_cast<float>(low + (high - low) * n / 9999));
  }
  return volume;
}

TEST(GreyMap, MapsTheWindowAndClampsAtTheThreshold) {
  const Volume grey = apply({-200, 1075, 55}, ramp(-1000, 2000));
  EXPECT_FLOAT_EQ(grey.samples.front(), 51);  // 55 HU
  EXPECT_FLOAT_EQ(grey.samples.back(), 255);
  const GreyMap map{-200, 1075, 55};
  for (const double native : {-200.0, 0.0, 300.0}) {
    EXPECT_DOUBLE_EQ(map.to_native(map.to_grey(native)), native);
  }
  EXPECT_DOUBLE_EQ(map.to_grey(1075), 255);
}

TEST(GreyMap, WithoutThresholdTheWindowStartsAtZero) {
  const Volume grey = apply({-200, 1075, -1e300}, ramp(-1000, 2000));
  EXPECT_FLOAT_EQ(grey.samples.front(), 0);
}

TEST(GreyMap, RefusesAnEmptyWindow) { EXPECT_THROW(apply({5, 5, 0}, ramp(0, 1)), InputError); }

TEST(Quantiles, OfARamp) {
  const auto q = quantiles(ramp(0, 1000).samples, {0.001, 0.5, 0.999});
  EXPECT_NEAR(q[0], 1, 0.5);
  EXPECT_NEAR(q[1], 500, 0.5);
  EXPECT_NEAR(q[2], 999, 0.5);
}

TEST(Otsu, SeparatesTwoClasses) {
  const OtsuSplit split = otsu_split(make_ball({.noise = 10}).samples);
  EXPECT_GT(split.threshold, 150);
  EXPECT_LT(split.threshold, 200);
  EXPECT_NEAR(split.mean_below, 120, 5);
  EXPECT_NEAR(split.mean_above, 220, 10);
}

TEST(Otsu, CanLookAtTheDarkSamplesAlone) {
  const Volume volume = make_ball({.background = 40, .object = 900, .noise = 10, .air = -1000});
  const OtsuSplit split = otsu_split(volume.samples, 400);
  EXPECT_NEAR(split.mean_below, -1000, 60);
  EXPECT_NEAR(split.mean_above, 40, 100);
}

TEST(DefaultWindow, GivesBoneItsContrastInHounsfieldUnits) {
  Volume ct = ramp(-1024, 3000);
  EXPECT_TRUE(is_hounsfield(ct));
  EXPECT_EQ(default_window(ct, 40).low, -200);
  EXPECT_EQ(default_window(ct, 40).high, 2000);
  EXPECT_NEAR(default_window(ct, -990).low, -1020, 5);
  ct.modality = "MR";
  EXPECT_FALSE(is_hounsfield(ct));
  EXPECT_NEAR(default_window(ct, 0).high, 2996, 5);
}

/// Values of a body in air, with a rod of metal.
Volume body_scan(double air, double metal, std::uint32_t seed = 1) {
  std::mt19937 generator(seed);
  std::normal_distribution<double> noise(0, 12);
  return sampled_volume({40, 36, 30}, {1, 1, 1}, [&](const Vec3& p) {
    const Vec3 q = p - Vec3{20, 18, 15};
    const double r = std::hypot(q.x, q.y), rod = std::hypot(q.x - 6, q.y);
    const double tissue = rod < 2 ? metal : r < 3 ? 700 : r < 11 ? 40 : r < 13 ? -90 : air;
    return std::clamp(tissue + noise(generator), -1024.0, 1e6);
  });
}

TEST(IsHounsfield, WhateverMetalIsAsBrightAs) {
  for (const double metal : {700.0, 3071.0, 20000.0, 65000.0}) {
    EXPECT_TRUE(is_hounsfield(body_scan(-1000, metal))) << metal;
  }
}

/// Of a body that fills the scan nothing is air: fat and soft tissue tell it.
TEST(IsHounsfield, WhereAPartOfAScanHasNoAir) {
  for (const double metal : {700.0, 20000.0}) {
    EXPECT_TRUE(is_hounsfield(body_scan(-100, metal))) << metal;
    EXPECT_TRUE(is_hounsfield(body_scan(50, metal))) << metal;
  }
}

TEST(IsHounsfield, IsNoImageOfOtherValues) {
  const auto changed = [](double slope, double offset, bool size = false) {
    Volume scan = body_scan(-1000, 3071);
    for (float& x : scan.samples) {
      const double value = slope * (static_cast<double>(x) + offset);
      x = static_cast<float>(size ? std::abs(value) : value);
    }
    return scan;
  };
  EXPECT_FALSE(is_hounsfield(changed(1, 1024))) << "MR, CT without its rescale";
  EXPECT_FALSE(is_hounsfield(changed(0.05, 1024))) << "8 bits";
  EXPECT_FALSE(is_hounsfield(changed(0.01, 0))) << "normalised";
  EXPECT_FALSE(is_hounsfield(changed(16, 500))) << "micro-CT";
  std::mt19937 generator(7);
  for (const double most : {3.2, 180.0, 4096.0}) {
    std::uniform_real_distribution<double> uniform(-most, most);
    EXPECT_FALSE(is_hounsfield(
        sampled_volume({40, 36, 30}, {1, 1, 1}, [&](const Vec3&) { return uniform(generator); })))
        << "phases up to " << most;
  }
  std::normal_distribution<double> noise(0, 30);
  const Volume difference = sampled_volume({40, 36, 30}, {1, 1, 1}, [&](const Vec3& p) {
    return p.x < 8 ? 0 : noise(generator) + (p.x > 30 ? 300 : 0);
  });
  EXPECT_FALSE(is_hounsfield(difference)) << "a difference of two images";
  // The dark tail of the noise in air or water of another scanner is no fat.
  for (const double deviation : {8.0, 10.0, 15.0}) {
    std::normal_distribution<double> of_phase(0, deviation);
    EXPECT_FALSE(is_hounsfield(sampled_volume({40, 40, 40}, {1, 1, 1}, [&](const Vec3& p) {
      const double r = norm(p - Vec3{20, 20, 20});
      return std::trunc((r < 8 ? 1000 : r < 15 ? 100 : 0) + of_phase(generator));
    }))) << deviation;
  }
}

TEST(DefaultWindow, IsNeverEmpty) {
  Volume rare = ramp(0, 0);
  rare.samples[17] = 1;  // beyond every percentile
  EXPECT_LT(default_window(rare, 0).low, default_window(rare, 0).high);
}

TEST(SampleRange, IsTheLeastAndTheLargest) {
  std::vector<float> samples(3'000'000, 5);  // more than one thread looks at
  samples[7] = -2;
  samples[2'999'999] = 9;
  EXPECT_EQ(sample_range(samples), std::pair(-2.0F, 9.0F));
  EXPECT_EQ(sample_range(std::vector<float>{3}), std::pair(3.0F, 3.0F));
}

TEST(Clamped, BoundsTheSamplesAndKeepsTheGrid) {
  Volume scan = sampled_volume({5, 4, 3}, {1, 1.5, 0.8}, [](const Vec3& p) { return 10 * p.x; });
  scan.modality = "CT";
  const Volume found = clamped(scan, {5, 25.5});
  EXPECT_EQ(found.spacing.y, 1.5);
  EXPECT_EQ(found.modality, "CT");
  for (Index i = 0; i < 5; ++i) {
    EXPECT_EQ(found.at(i, 3, 2), std::min(std::max(10.0F * static_cast<float>(i), 5.0F), 25.5F));
  }
}

/// The mean of neighbours along each axis in turn, the border repeated.
TEST(Smoothed, IsTheProductOfThreeFilters) {
  std::mt19937 generator(4);
  std::uniform_real_distribution<double> uniform(0, 100);
  const Volume scan =
      sampled_volume({6, 5, 37}, {1, 1.5, 0.8}, [&](const Vec3&) { return uniform(generator); });
  const Volume found = smoothed(scan);
  const auto at = [&](Index i, Index j, Index k) {
    return scan.at(std::clamp(i, 0, 5), std::clamp(j, 0, 4), std::clamp(k, 0, 36));
  };
  for (Index k = 0; k < 37; ++k) {
    for (Index j = 0; j < 5; ++j) {
      for (Index i = 0; i < 6; ++i) {
        double sum = 0;
        for (Index n = 0; n < 27; ++n) {
          const Index x = n % 3 - 1, y = n / 3 % 3 - 1, z = n / 9 - 1;
          const double weight = (2 - std::abs(x)) * (2 - std::abs(y)) * (2 - std::abs(z)) / 64.0;
          sum += weight * at(i + x, j + y, k + z);
        }
        EXPECT_NEAR(found.at(i, j, k), sum, 1e-4);
      }
    }
  }
}

TEST(Smoothed, DoesNotMixSlicesThatAreFarApart) {
  Volume scan = sampled_volume({5, 5, 5}, {1, 1, 2}, [](const Vec3& p) { return p.z == 4; });
  EXPECT_EQ(smoothed(scan).at(2, 2, 1), 0.25f);
  scan.spacing.z = 2.5;
  EXPECT_EQ(smoothed(scan).at(2, 2, 1), 0);
  EXPECT_EQ(smoothed(scan).at(2, 2, 2), 1);
}

TEST(Smoothed, KeepsConstantsAndTheSumOfAPeak) {
  Volume volume = ramp(0, 0);
  volume.size = {25, 20, 20};
  volume.samples.assign(10'000, 3);
  for (const float sample : smoothed(volume).samples) EXPECT_FLOAT_EQ(sample, 3);
  volume.samples.assign(10'000, 0);
  volume.samples[volume.offset(10, 10, 10)] = 4096;
  const Volume peak = smoothed(volume);
  double sum = 0;
  for (const float sample : peak.samples) sum += sample;
  EXPECT_DOUBLE_EQ(sum, 4096);
  EXPECT_FLOAT_EQ(peak.at(10, 10, 10), 512);
  EXPECT_FLOAT_EQ(peak.at(9, 10, 10), 256);
  EXPECT_FLOAT_EQ(peak.at(8, 10, 10), 0);
}

}  // namespace
}  // namespace mesamis
