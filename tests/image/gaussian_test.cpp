// SPDX-License-Identifier: Apache-2.0
#include "mesamis/image/gaussian.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

#include "mesamis/base/parallel.h"
#include "support/sampled_volume.h"
#include "support/throws.h"

namespace mesamis {
namespace {

using testing::HasSubstr;

Volume constant(float value, const std::array<Index, 3>& size = {48, 40, 52}) {
  return sampled_volume(size, {1, 2, 3}, [value](const Vec3&) { return value; });
}

TEST(Gaussian, OfAPointIsTheKernelOfEachAxisInVoxels) {
  Volume volume = constant(0, {31, 31, 31});
  volume.samples[volume.offset(15, 15, 15)] = 1000;
  const double sigma = 1.5;
  const Volume smooth = gaussian_smoothed(volume, sigma);
  double sum = 0, variance = 0;
  for (Index k = 0; k < 31; ++k) {
    for (Index j = 0; j < 31; ++j) {
      for (Index i = 0; i < 31; ++i) {
        const double x = smooth.at(i, j, k);
        sum += x;
        variance += x * (i - 15) * (i - 15);
        EXPECT_EQ(smooth.at(i, j, k), smooth.at(30 - i, j, k));
        EXPECT_NEAR(x, smooth.at(k, i, j), 1e-5);
      }
    }
  }
  EXPECT_NEAR(sum, 1000, 1e-3);
  EXPECT_NEAR(variance / sum, sigma * sigma, 0.01);  // four deviations are not all
  EXPECT_NEAR(smooth.at(17, 15, 15) / smooth.at(15, 15, 15), std::exp(-2 / (sigma * sigma)), 1e-6);
}

TEST(Gaussian, ReachesAsFarAsItSays) {
  for (const double sigma : {0.2, 0.5, 1.5, 2.3}) {
    Volume volume = constant(0, {3, 3, 41});
    volume.samples[volume.offset(1, 1, 20)] = 1e6F;
    const Volume smooth = gaussian_smoothed(volume, sigma);
    const Index reach = gaussian_reach(sigma);
    EXPECT_GT(smooth.at(1, 1, 20 + reach), 0) << sigma;
    EXPECT_EQ(smooth.at(1, 1, 20 + reach + 1), 0) << sigma;
  }
  EXPECT_EQ(gaussian_reach(0), 0);
}

TEST(Gaussian, KeepsConstants) {
  for (const float x : gaussian_smoothed(constant(123), 3).samples) EXPECT_NEAR(x, 123, 1e-4);
  const Volume thin = constant(5, {2, 2, 40});  // shorter than the Gaussian
  for (const float x : gaussian_smoothed(thin, 6).samples) EXPECT_NEAR(x, 5, 1e-5);
}

Volume waves(const std::array<Index, 3>& size) {
  return sampled_volume(size, {1, 1, 1}, [](const Vec3& p) {
    return 100 * std::sin(1.3 * p.x + 0.4) * std::cos(0.7 * p.y * p.z) + p.x * p.y;
  });
}

/// The definition: the sum over all neighbours within four standard deviations.
double smoothed_at(const Volume& volume, const std::array<Index, 3>& at, double sigma) {
  const auto radius = static_cast<Index>(std::ceil(4 * sigma));
  const auto inside = [&volume](std::size_t axis, Index i) {
    return std::clamp(i, Index{0}, volume.size[axis] - 1);
  };
  double sum = 0, weights = 0;
  for (Index k = -radius; k <= radius; ++k) {
    for (Index j = -radius; j <= radius; ++j) {
      for (Index i = -radius; i <= radius; ++i) {
        const double weight = std::exp(-0.5 * (i * i + j * j + k * k) / (sigma * sigma));
        weights += weight;
        sum += weight * volume.at(inside(0, at[0] + i), inside(1, at[1] + j), inside(2, at[2] + k));
      }
    }
  }
  return sum / weights;
}

TEST(Gaussian, AgreesWithItsDefinition) {
  const Volume volume = waves({9, 5, 7});
  for (const double sigma : {0.3, 0.8, 1.7}) {
    const Volume smooth = gaussian_smoothed(volume, sigma);
    for (const auto& at :
         std::vector<std::array<Index, 3>>{{0, 0, 0}, {8, 4, 6}, {4, 2, 3}, {1, 4, 5}}) {
      EXPECT_NEAR(smooth.at(at[0], at[1], at[2]), smoothed_at(volume, at, sigma), 1e-4) << sigma;
    }
  }
}

TEST(Gaussian, LeavesTheGridAndWithoutWidthTheSamples) {
  Volume volume = waves({6, 5, 4});
  volume.origin = {1, 2, 3};
  const Volume same = gaussian_smoothed(volume, 0);
  EXPECT_EQ(same.samples, volume.samples);
  EXPECT_EQ(gaussian_smoothed(volume, 1).origin, volume.origin);
}

TEST(Gaussian, GivesTheSameBitsForAnyNumberOfThreads) {
  const Volume volume = waves({33, 21, 17});
  const Volume one = with_threads(1, [&] { return gaussian_smoothed(volume, 1.2); });
  const Volume four = with_threads(4, [&] { return gaussian_smoothed(volume, 1.2); });
  EXPECT_EQ(one.samples, four.samples);
}

/// One voxel of value 5 and weight 2, one of value -1 and weight 1.
TEST(WeightedMeans, AreThoseNearbyAndNothingFarAway) {
  Volume weights = waves({40, 9, 9}), weighted = weights;
  std::fill(weights.samples.begin(), weights.samples.end(), 0.0F);
  weighted.samples = weights.samples;
  const std::size_t one = weights.offset(6, 4, 4), other = weights.offset(8, 4, 4);
  weights.samples[one] = 2;
  weighted.samples[one] = 10;
  weights.samples[other] = 1;
  weighted.samples[other] = -1;
  const WeightedMeans means(weighted, weights, 1.5, 1e-6);
  EXPECT_NEAR(means.at(weights.offset(7, 4, 4)), 3, 1e-3) << "equally far: by weight";
  EXPECT_GT(means.at(one), 3);
  EXPECT_LT(means.at(other), 3);
  EXPECT_EQ(means.at(weights.offset(30, 4, 4)), 0);
}

TEST(Gaussian, RefusesAWidthOutOfRangeAndMissingSamples) {
  Volume volume = waves({6, 5, 4});
  for (const double sigma : {-0.1, 100.1, std::nan("")}) {
    EXPECT_REFUSED(gaussian_smoothed(volume, sigma), HasSubstr("0 to 100 voxels"));
  }
  volume.samples.pop_back();
  EXPECT_REFUSED(gaussian_smoothed(volume, 1), HasSubstr("expected 120 samples, found 119"));
}

}  // namespace
}  // namespace mesamis
