// SPDX-License-Identifier: Apache-2.0
#include "mesamis/restore/deblur.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <numbers>
#include <numeric>
#include <vector>

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

Volume white_noise() {
  const Volume flat = sampled_volume({64, 72, 68}, {1, 1, 1}, [](const Vec3&) { return 100; });
  return degrade(flat, {.noise = 10});
}

/// Of that noise, away from the borders, which mirror it.
double deviation(const Volume& volume) {
  const CropRange inner{{10, 10, 10}, {54, 62, 58}};
  const std::vector<float> samples = crop(volume, inner).samples;
  double squares = 0;
  for (const float x : samples) squares += (x - 100) * (x - 100);
  return std::sqrt(squares / static_cast<double>(samples.size()));
}

/// The sum over the voxels on a line through each voxel, weighted by their distance along it.
Volume filtered(const Volume& volume, int axis, const std::vector<double>& weights) {
  return sampled_volume(volume.size, volume.spacing, [&](const Vec3& p) {
    double sum = 0;
    for (Index d = 1 - static_cast<Index>(weights.size()); d < std::ssize(weights); ++d) {
      std::array<Index, 3> v;
      for (int a = 0; a < 3; ++a) {
        const auto n = static_cast<std::size_t>(a);
        v[n] = std::clamp<Index>(static_cast<Index>(p[a]) + (a == axis ? d : 0), 0,
                                 volume.size[n] - 1);
      }
      sum += weights[static_cast<std::size_t>(std::abs(d))] * volume.at(v[0], v[1], v[2]);
    }
    return sum;
  });
}

TEST(Deblur, NoiseGrowsByItsGain) {
  const Volume noise = white_noise();
  for (const double regularization : {0.002, 0.05, 1.0}) {
    const double gain = noise_gain(kUnequal, regularization);
    EXPECT_NEAR(deviation(deblurred(noise, kUnequal, regularization)) / deviation(noise), gain,
                0.03 * gain);
  }
  EXPECT_DOUBLE_EQ(noise_gain({0, 0, 0}, kRegularization), 1);
}

TEST(Deblur, MeansAlongASurfaceHaveTheNoiseOfTheirGain) {
  // A Gaussian of 0.8 voxels, and noise that neighbours along x share: a, 1, a.
  std::vector<double> gaussian;
  for (const double d : {0, 1, 2, 3, 4}) gaussian.push_back(std::exp(-d * d / (2 * 0.8 * 0.8)));
  const double sum = std::accumulate(gaussian.begin() + 1, gaussian.end(), 0.5) * 2;
  for (double& weight : gaussian) weight /= sum;
  for (const double share : {0.0, 0.2, -0.2}) {
    const Volume noise = filtered(white_noise(), 0, {1 - 2 * share, share});
    const double square = (1 - 2 * share) * (1 - 2 * share) + 2 * share * share;
    const std::array<double, 3> correlation{2 * share * (1 - 2 * share) / square, 0, 0};
    for (const double regularization : {0.01, 1.0}) {
      const Volume restored = deblurred(noise, kUnequal, regularization);
      const auto gains = noise_gain_along_surface(kUnequal, regularization, correlation);
      for (int across = 0; across < 3; ++across) {
        Volume means = restored;
        for (int a = 0; a < 3; ++a) {
          if (a != across) means = filtered(means, a, gaussian);
        }
        const double gain = gains[static_cast<std::size_t>(across)];
        EXPECT_NEAR(deviation(means) / deviation(noise), gain, 0.08 * gain)
            << share << ' ' << regularization << ' ' << across;
      }
    }
  }
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
