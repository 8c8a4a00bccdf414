// SPDX-License-Identifier: Apache-2.0
#include "mesamis/image/spline_image.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "mesamis/base/parallel.h"
#include "support/sampled_volume.h"

namespace mesamis {
namespace {

Volume random_volume(const std::array<Index, 3>& size) {
  std::mt19937 generator(7);
  std::uniform_real_distribution<double> uniform(0, 100);
  return sampled_volume(size, {1, 0.5, 2}, [&](const Vec3&) { return uniform(generator); });
}

TEST(SplineImage, PassesThroughItsSamples) {
  for (const std::array<Index, 3> size :
       {std::array<Index, 3>{9, 8, 7}, {2, 2, 2}, {3, 2, 12}, {2, 30, 3}}) {
    const Volume volume = random_volume(size);
    const SplineImage image = interpolating_spline(volume);
    for (Index k = 0; k < size[2]; ++k) {
      for (Index j = 0; j < size[1]; ++j) {
        SplineLine line(image, j, k);
        for (Index i = 0; i < size[0]; ++i) {
          EXPECT_NEAR(line.at(i), volume.at(i, j, k), 1e-4);
          EXPECT_NEAR(spline_at(image, {i * 1.0, j * 0.5, k * 2.0}).value, volume.at(i, j, k),
                      1e-4);
        }
      }
    }
  }
}

TEST(SplineImage, ReproducesLinearImagesUpToTheBorder) {
  const auto linear = [](const Vec3& p) { return 3 + 2 * p.x - p.y + 0.5 * p.z; };
  const SplineImage image = interpolating_spline(sampled_volume({6, 5, 9}, {1, 2, 0.5}, linear));
  for (const Vec3& p : {Vec3{0.3, 0.1, 3.9}, Vec3{4.9, 7.7, 0.1}, Vec3{2.5, 4.2, 2.2}}) {
    const ImageValue found = spline_at(image, p);
    EXPECT_NEAR(found.value, linear(p), 1e-4);
    EXPECT_LT(norm(found.gradient - Vec3{2, -1, 0.5}), 1e-4);
  }
}

/// The error on a smooth image falls with the fourth power of the spacing; the gradient's with the
/// third.
TEST(SplineImage, ConvergesWithTheFourthOrder) {
  const auto wave = [](const Vec3& p) { return std::sin(p.x + 0.5 * p.y) * std::cos(0.7 * p.z); };
  const auto error = [&wave](Index n) {
    const double h = 8.0 / (n - 1);
    const SplineImage image = interpolating_spline(sampled_volume({n, n, n}, {h, h, h}, wave));
    double worst = 0;
    for (double t = 3; t < 5; t += 0.037) {
      const Vec3 p{t, 8 - t, 4.3};
      worst = std::max(worst, std::abs(spline_at(image, p).value - wave(p)));
    }
    return worst;
  };
  EXPECT_GT(error(17) / error(33), 12);
}

TEST(SplineImage, GradientIsThatOfTheValues) {
  const SplineImage image = interpolating_spline(random_volume({8, 9, 7}));
  constexpr double kStep = 1e-5;
  for (const Vec3& p : {Vec3{0.2, 0.1, 0.3}, Vec3{3.4, 2.2, 7.7}, Vec3{6.9, 3.9, 11.8}}) {
    const Vec3 gradient = spline_at(image, p).gradient;
    for (int a = 0; a < 3; ++a) {
      Vec3 before = p, behind = p;
      before[a] -= kStep;
      behind[a] += kStep;
      const double slope =
          (spline_at(image, behind).value - spline_at(image, before).value) / (2 * kStep);
      EXPECT_NEAR(gradient[a], slope, 1e-4 * std::max(1.0, std::abs(slope)));
    }
  }
}

TEST(SplineImage, TheValueAloneIsTheSameAndWithinTheCoefficientsAround) {
  const SplineImage image = interpolating_spline(random_volume({9, 2, 7}));
  const auto [low, high] =
      std::minmax_element(image.coefficients.begin(), image.coefficients.end());
  for (double t = -0.5; t < 9; t += 0.0931) {
    const Vec3 p{t, 0.06 * t, 1.9 * (7 - t)};
    const double value = spline_value_at(image, p);
    EXPECT_EQ(value, spline_at(image, p).value);
    EXPECT_GE(value, *low);
    EXPECT_LE(value, *high);
  }
}

TEST(SplineImage, BoundsActBetweenTheVoxels) {
  SplineImage image = interpolating_spline(
      sampled_volume({9, 4, 4}, {1, 1, 1}, [](const Vec3& p) { return p.x < 4 ? 0.0 : 100.0; }));
  image.low = 20;
  image.high = 90;
  SplineLine line(image, 1, 1);
  EXPECT_EQ(line.at(1), 20);
  EXPECT_EQ(line.at(7), 90);
  EXPECT_NEAR(line.at(3.5), 50, 0.01);
}

TEST(SplineLine, IsTheSameInAnyOrderOfPlaces) {
  const SplineImage image = interpolating_spline(random_volume({20, 5, 5}));
  SplineLine ahead(image, 1.3, 2.6);
  for (double x = -1; x < 21; x += 0.37) {
    SplineLine fresh(image, 1.3, 2.6);
    const double expected = fresh.at(x);
    EXPECT_EQ(ahead.at(x), expected);
    EXPECT_NEAR(
        expected,
        std::clamp<double>(spline_at(image, {x, 1.3 * 0.5, 2.6 * 2}).value, image.low, image.high),
        1e-9);
  }
  const double first = SplineLine(image, 1.3, 2.6).at(2.5);
  EXPECT_EQ(ahead.at(2.5), first);
}

TEST(SplineLine, MovesToOtherLinesOfItsSlices) {
  const SplineImage image = interpolating_spline(random_volume({20, 5, 5}));
  SplineLine moved(image, 2);
  for (const double y : {0.0, 1.3, 4.0, 1.0}) {
    moved.move_to(y);
    SplineLine fresh(image, y, 2);
    for (double x = 0; x < 20; x += 0.7) EXPECT_EQ(moved.at(x), fresh.at(x));
  }
}

TEST(SplinePatch, HasTheBitsOfALine) {
  const SplineImage image = interpolating_spline(random_volume({6, 5, 4}));
  SplinePatch patch(image);
  for (double t = -1; t < 7; t += 0.043) {
    const Vec3 p{t, 5 - t, 0.8 * t};
    EXPECT_EQ(patch.at(p), SplineLine(image, p.y, p.z).at(p.x));
  }
  EXPECT_EQ(patch.at({2, 3, 1}), SplineLine(image, 3, 1).at(2)) << "a voxel";
}

TEST(SplineImage, SameBitsForAnyNumberOfThreads) {
  const Volume volume = random_volume({30, 20, 25});
  const SplineImage one = with_threads(1, [&] { return interpolating_spline(volume); });
  const SplineImage three = with_threads(3, [&] { return interpolating_spline(volume); });
  EXPECT_TRUE(std::ranges::equal(one.coefficients, three.coefficients));
}

TEST(SplineImage, CopiesShareTheirCoefficients) {
  SplineImage copy;
  std::vector<float> values;
  {
    const SplineImage image = interpolating_spline(random_volume({9, 8, 7}));
    values.assign(image.coefficients.begin(), image.coefficients.end());
    copy = image;
    EXPECT_EQ(copy.coefficients.data(), image.coefficients.data());
  }
  EXPECT_TRUE(std::ranges::equal(copy.coefficients, values)) << "the owner is still there";
}

}  // namespace
}  // namespace mesamis
