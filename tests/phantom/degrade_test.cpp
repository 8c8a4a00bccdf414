// SPDX-License-Identifier: Apache-2.0
#include "mesamis/phantom/degrade.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "mesamis/base/parallel.h"
#include "mesamis/image/gaussian.h"
#include "support/sampled_volume.h"
#include "support/throws.h"

namespace mesamis {
namespace {

using testing::HasSubstr;

Volume constant(float value, const std::array<Index, 3>& size = {48, 40, 52}) {
  return sampled_volume(size, {1, 2, 3}, [value](const Vec3&) { return value; });
}

struct Moments {
  double mean = 0, deviation = 0;
};

Moments moments_of(const Volume& volume) {
  Moments m;
  const auto n = static_cast<double>(volume.samples.size());
  for (const float x : volume.samples) m.mean += x / n;
  for (const float x : volume.samples) m.deviation += (x - m.mean) * (x - m.mean) / n;
  m.deviation = std::sqrt(m.deviation);
  return m;
}

TEST(Degrade, DoesNothingUnasked) {
  const Volume volume = constant(7);
  EXPECT_EQ(degrade(volume, {}).samples, volume.samples);
}

TEST(Degrade, BlursByTheGaussian) {
  Volume volume = constant(0, {9, 8, 7});
  volume.samples[volume.offset(4, 2, 6)] = 1000;
  EXPECT_EQ(degrade(volume, {.blur = 1.5}).samples, gaussian_smoothed(volume, 1.5).samples);
}

TEST(Degrade, NoiseHasMeanZeroAndTheAskedDeviation) {
  const Volume volume = constant(100);
  const double n = static_cast<double>(volume.samples.size());
  for (const double sigma : {1.0, 15.0}) {
    const Moments m = moments_of(degrade(volume, {.noise = sigma}));
    EXPECT_NEAR(m.mean, 100, 4 * sigma / std::sqrt(n));
    EXPECT_NEAR(m.deviation, sigma, 4 * sigma / std::sqrt(2 * n));
  }
}

TEST(Degrade, NoiseIsNormalAndOfIndependentVoxels) {
  const Volume noise = degrade(constant(0), {.noise = 1});
  const double n = static_cast<double>(noise.samples.size());
  double within = 0, beyond = 0, neighbours = 0;
  for (std::size_t i = 0; i < noise.samples.size(); ++i) {
    const double x = noise.samples[i];
    within += std::abs(x) < 1;
    beyond += std::abs(x) > 2;
    if (i > 0) neighbours += x * noise.samples[i - 1];
  }
  EXPECT_NEAR(within / n, 0.6827, 4 * 0.4655 / std::sqrt(n));
  EXPECT_NEAR(beyond / n, 0.0455, 4 * 0.2084 / std::sqrt(n));
  EXPECT_NEAR(neighbours / n, 0, 4 / std::sqrt(n));
}

TEST(Degrade, SpeckleGrowsWithTheValue) {
  EXPECT_NEAR(moments_of(degrade(constant(50), {.speckle = 0.1})).deviation, 5, 0.06);
  EXPECT_NEAR(moments_of(degrade(constant(200), {.speckle = 0.1})).deviation, 20, 0.24);
  EXPECT_EQ(degrade(constant(0), {.speckle = 0.1}).samples, constant(0).samples);
}

TEST(Degrade, SaltAndPepperTakeTheirShares) {
  const Volume volume = degrade(constant(100), {.salt_pepper = 0.1, .pepper = -5, .salt = 300});
  const double n = static_cast<double>(volume.samples.size());
  const auto share = [&](float value) {
    return static_cast<double>(std::count(volume.samples.begin(), volume.samples.end(), value)) / n;
  };
  const double bound = 4 * std::sqrt(0.05 * 0.95 / n);
  EXPECT_NEAR(share(300), 0.05, bound);
  EXPECT_NEAR(share(-5), 0.05, bound);
  EXPECT_DOUBLE_EQ(share(100) + share(300) + share(-5), 1);
}

TEST(Degrade, SameSeedSameBytesOnAnyNumberOfThreads) {
  const Volume volume =
      sampled_volume({33, 20, 41}, {1, 1, 1}, [](const Vec3& p) { return p.x + p.y * p.z; });
  DegradeOptions options{.blur = 1.2, .speckle = 0.1, .noise = 3, .salt_pepper = 0.01, .seed = 7};
  const Volume first = degrade(volume, options);
  with_threads(1, [&] { EXPECT_EQ(degrade(volume, options).samples, first.samples); });
  options.seed = 8;
  EXPECT_NE(degrade(volume, options).samples, first.samples);
}

TEST(Degrade, OneKindOfNoiseDoesNotShiftAnother) {
  const Volume noise = degrade(constant(100), {.noise = 2});
  const Volume both = degrade(constant(100), {.noise = 2, .salt_pepper = 0.2});
  for (std::size_t n = 0; n < noise.samples.size(); ++n) {
    if (both.samples[n] == 0 || both.samples[n] == 255) continue;
    ASSERT_EQ(both.samples[n], noise.samples[n]);
  }
}

/// The blur reaches over the slab's ends, and the noise goes on where the slab before ended.
TEST(DegradedSlices, AreThoseOfTheWholeForAnyHeight) {
  const Volume sharp = sampled_volume({9, 7, 23}, {1, 1, 1}, [](const Vec3& p) {
    return 100 + 30 * std::sin(p.x * p.y) + 50 * (std::fmod(p.z, 5) < 2);
  });
  const VolumeSlices source(sharp);
  for (const double blur : {0.0, 0.3, 1.0, 2.6, 40.0}) {
    const DegradeOptions options{
        .blur = blur, .speckle = 0.1, .noise = 3, .salt_pepper = 0.05, .seed = 11};
    const Volume whole = degrade(sharp, options);
    const DegradedSlices slices(source, options);
    for (const Index height : {1, 5, 23}) {
      for (Index first = 0; first < 23; first += height) {
        const Index count = std::min(height, 23 - first);
        EXPECT_EQ(slices.read(first, count), VolumeSlices(whole).read(first, count))
            << "blur " << blur << ", slices " << first << " to " << first + count;
      }
    }
  }
}

TEST(DegradedSlices, NoiseOfAVoxelIsThatOfItsPlaceInTheWhole) {
  const Volume flat = constant(0, {8, 8, 20});
  const VolumeSlices source(flat);
  const DegradedSlices noise(source, {.noise = 1});
  const std::vector<float> early = noise.read(3, 2), late = noise.read(4, 1);
  EXPECT_EQ(std::vector<float>(early.begin() + 64, early.end()), late);
  EXPECT_NE(std::vector<float>(early.begin(), early.begin() + 64), late);
}

TEST(DegradedSlices, ReadAtLeastAsManySlicesAsTheBlurAdds) {
  VolumeView grid;  // its samples are not asked for
  grid.size = {4096, 4096, 4096};
  const VolumeSlices large(grid);
  EXPECT_EQ(DegradedSlices(large, {}).slab(), 4);
  EXPECT_EQ(DegradedSlices(large, {.blur = 2}).slab(), 16);
  grid.size = {64, 64, 20};
  const VolumeSlices small(grid);
  EXPECT_EQ(DegradedSlices(small, {.blur = 9}).slab(), 20);
}

TEST(Degrade, RefusesWhatIsOutOfRange) {
  const Volume volume = constant(1);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_REFUSED(degrade(volume, {.blur = -1}), HasSubstr("blur: expected 0 to 100, found -1"));
  EXPECT_REFUSED(degrade(volume, {.blur = 101}), HasSubstr("blur"));
  EXPECT_REFUSED(degrade(volume, {.noise = -0.5}), HasSubstr("expected 0 or more, found -0.5"));
  EXPECT_REFUSED(degrade(volume, {.noise = nan}), HasSubstr("noise"));
  EXPECT_REFUSED(degrade(volume, {.speckle = -1}), HasSubstr("speckle"));
  EXPECT_REFUSED(degrade(volume, {.salt_pepper = 1.1}), HasSubstr("salt-pepper"));
  const VolumeSlices source(volume);
  EXPECT_REFUSED(DegradedSlices(source, {.blur = 101}), HasSubstr("blur"));
}

}  // namespace
}  // namespace mesamis
