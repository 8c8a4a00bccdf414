// SPDX-License-Identifier: Apache-2.0
#include "mesamis/restore/deblur.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <numbers>

#include "mesamis/base/parallel.h"
#include "mesamis/phantom/degrade.h"
#include "mesamis/phantom/phantom.h"
#include "support/sampled_volume.h"
#include "support/throws.h"

namespace mesamis {
namespace {

using testing::HasSubstr;

constexpr double kRegularization = 0.02;
constexpr std::array<double, 3> kUnequal{1.2, 0.6, 0.9};

double filter(double lambda) {
  const double g = std::exp(-lambda / 2);
  return g / (g * g + kRegularization * lambda * lambda);
}

TEST(Deblur, KeepsAConstantAndLeavesWhatIsSharp) {
  const Volume flat = sampled_volume({9, 12, 10}, {1, 1, 1}, [](const Vec3&) { return 40; });
  for (const float x : deblurred(flat, kUnequal, kRegularization).samples) EXPECT_NEAR(x, 40, 0.01);
  const Volume ramp = sampled_volume({9, 12, 10}, {1, 1, 1}, [](const Vec3& p) { return p.x; });
  EXPECT_TRUE(deblurred(ramp, {0, 0, 0}, kRegularization).samples == ramp.samples);
}

TEST(Deblur, EveryWaveIsScaledByTheFilter) {
  // cos(pi m (i + 1/2) / n) is an eigenfunction of a difference with mirrored borders.
  const std::array<Index, 3> size{16, 12, 20};
  for (const std::array<Index, 3> wave :
       {std::array<Index, 3>{1, 0, 0}, {5, 0, 0}, {0, 6, 0}, {0, 0, 9}, {2, 3, 4}, {15, 11, 19}}) {
    double lambda = 0;
    for (std::size_t a = 0; a < 3; ++a) {
      const double symbol = 2 - 2 * std::cos(std::numbers::pi * wave[a] / size[a]);
      lambda += kUnequal[a] * kUnequal[a] * (symbol + symbol * symbol / 12);
    }
    const auto value = [&](const Vec3& p) {
      double product = 100;
      for (int a = 0; a < 3; ++a) {
        const auto n = static_cast<std::size_t>(a);
        product *= std::cos(std::numbers::pi * wave[n] * (p[a] + 0.5) / size[n]);
      }
      return product;
    };
    const Volume image = sampled_volume(size, {1, 1, 1}, value);
    const Volume found = deblurred(image, kUnequal, kRegularization);
    for (std::size_t n = 0; n < image.samples.size(); ++n) {
      EXPECT_NEAR(found.samples[n], filter(lambda) * image.samples[n], 0.03);
    }
  }
}

TEST(Deblur, NoiseGrowsByItsGain) {
  const Volume flat = sampled_volume({64, 72, 68}, {1, 1, 1}, [](const Vec3&) { return 100; });
  const Volume noise = degrade(flat, {.noise = 10});
  const auto deviation = [](const Volume& volume) {  // away from the borders, which mirror it
    const CropRange inner{{10, 10, 10}, {54, 62, 58}};
    const std::vector<float> samples = crop(volume, inner).samples;
    double squares = 0;
    for (const float x : samples) squares += (x - 100) * (x - 100);
    return std::sqrt(squares / static_cast<double>(samples.size()));
  };
  for (const double regularization : {0.002, 0.05, 1.0}) {
    const double gain = noise_gain(kUnequal, regularization);
    EXPECT_NEAR(deviation(deblurred(noise, kUnequal, regularization)) / deviation(noise), gain,
                0.03 * gain);
  }
  EXPECT_DOUBLE_EQ(noise_gain({0, 0, 0}, kRegularization), 1);
}

/// Volume of what is above the level, from the mean of the samples clamped to both sides.
double radius_of(const Volume& volume, double outside, double inside) {
  double sum = 0;
  for (const float x : volume.samples) {
    sum += std::clamp((x - (outside + inside) / 2) * 4 / (inside - outside) + 0.5, 0.0, 1.0);
  }
  return std::cbrt(sum * 3 / (4 * std::numbers::pi));
}

TEST(Deblur, BringsASurfaceBackFromTheCentreOfCurvature) {
  const double radius = 5;
  const Volume sharp = sampled_volume({24, 24, 24}, {1, 1, 1}, [radius](const Vec3& p) {
    return 100 * std::clamp(radius - norm(p - Vec3{11.5, 11.5, 11.5}) + 0.5, 0.0, 1.0);
  });
  const Volume blurred = degrade(sharp, {.blur = 1.2});
  const double shifted = radius - radius_of(blurred, 0, 100);
  EXPECT_GT(shifted, 0.15);  // sigma^2 / R is 0.29
  const double left = radius - radius_of(deblurred(blurred, {1.2, 1.2, 1.2}, 0.01), 0, 100);
  EXPECT_LT(std::abs(left), 0.3 * shifted);
}

TEST(Deblur, SameBitsForAnyNumberOfThreads) {
  const Volume scan = degrade(sample_phantom(make_phantom("sphere")), {.blur = 1, .noise = 20});
  const Volume one = with_threads(1, [&] { return deblurred(scan, kUnequal, kRegularization); });
  const Volume three = with_threads(3, [&] { return deblurred(scan, kUnequal, kRegularization); });
  EXPECT_TRUE(one.samples == three.samples);
}

TEST(Deblur, RefusesWhatIsOutOfRange) {
  const Volume flat = sampled_volume({4, 4, 4}, {1, 1, 1}, [](const Vec3&) { return 1; });
  using Blur = std::array<double, 3>;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto refused = [&flat](const Blur& blur, double regularization, const char* text) {
    EXPECT_REFUSED(deblurred(flat, blur, regularization), HasSubstr(text));
  };
  refused({1, -1, 1}, 0.1, "blur in voxels of 0 to 3");
  refused({1, 3.5, 1}, 0.1, "found 3.5");
  refused({1, 1, nan}, 0.1, "blur");
  refused({1, 1, 1}, 0, "regularization");
}

}  // namespace
}  // namespace mesamis
