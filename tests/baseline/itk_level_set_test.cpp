// SPDX-License-Identifier: Apache-2.0
#include "mesamis/baseline/itk_level_set.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "mesamis/baseline/geodesic_contour.h"
#include "support/sampled_volume.h"

namespace mesamis {
namespace {

constexpr std::array<Index, 3> kSize{24, 22, 20};
constexpr Vec3 kSpacing{1, 1.25, 1.5};

class ItkLevelSetTest : public testing::Test {
 protected:
  void SetUp() override {
    if (!have_itk()) GTEST_SKIP() << "the library was built without ITK";
  }
};

Vec3 center() { return 0.5 * Vec3{23 * kSpacing.x, 21 * kSpacing.y, 19 * kSpacing.z}; }

/// Positive in a ball around the middle: the distance from its surface in mm, which here are
/// voxels.
Volume ball_distance(double radius) {
  return sampled_volume(kSize, kSpacing,
                        [radius](const Vec3& p) { return radius - norm(p - center()); });
}

double variance(const Volume& volume) {
  double sum = 0, squares = 0;
  for (const float x : volume.samples) sum += x, squares += double{x} * x;
  const auto n = static_cast<double>(volume.samples.size());
  return squares / n - sum * sum / (n * n);
}

/// Radius of the ball with as much volume as lies above 0.
double radius_of(const Volume& level_set) {
  double count = 0;
  for (const float x : level_set.samples) count += std::clamp(x + 0.5, 0.0, 1.0);
  const Vec3& s = level_set.spacing;
  return std::cbrt(count * s.x * s.y * s.z * 3 / (4 * std::numbers::pi));
}

TEST_F(ItkLevelSetTest, DiffusionKeepsConstantsAndEdgesButNotNoise) {
  const Volume constant = sampled_volume(kSize, kSpacing, [](const Vec3&) { return 7; });
  for (const float x : diffused(constant, 3, 1, {}).samples) EXPECT_EQ(x, 7);
  const Volume noise = sampled_volume(kSize, kSpacing, [](const Vec3& p) {
    return std::sin(37.1 * p.x + 11.7 * p.y * p.y + 5.3 * p.z * p.x);
  });
  EXPECT_LT(variance(diffused(noise, 10, 3, {})), 0.5 * variance(noise));
  const Volume step =
      sampled_volume(kSize, kSpacing, [](const Vec3& p) { return p.x < 11 ? 0 : 100; });
  const Volume smooth = diffused(step, 10, 0.5, {});
  EXPECT_LT(smooth.at(10, 10, 10), 10);
  EXPECT_GT(smooth.at(11, 10, 10), 90);
}

TEST_F(ItkLevelSetTest, GradientOfALinearFieldIsItsSlopePerMm) {
  const Volume linear =
      sampled_volume(kSize, kSpacing, [](const Vec3& p) { return 3 * p.x - 4 * p.y + 12 * p.z; });
  const Volume gradient = gradient_magnitude(linear, 1);
  // Away from the border, where the field is continued by a constant.
  for (Index k = 8; k < 12; ++k) {
    for (Index j = 8; j < 14; ++j) EXPECT_NEAR(gradient.at(12, j, k), 13, 0.02);
  }
}

TEST_F(ItkLevelSetTest, DistanceIsThatOfABallAndClamped) {
  Volume steep = ball_distance(8);
  for (float& x : steep.samples) x = 50 + 10 * x;
  const Volume exact = ball_distance(8), found = signed_distance(steep, 50, 3);
  EXPECT_EQ(found.size, exact.size);
  double sum = 0;
  for (std::size_t n = 0; n < found.samples.size(); ++n) {
    const double error = found.samples[n] - std::clamp(exact.samples[n], -3.0f, 3.0f);
    EXPECT_LT(std::abs(error), 0.75) << "half the longest side: fast marching is of first order";
    EXPECT_LE(std::abs(found.samples[n]), 3);
    sum += std::abs(error);
  }
  EXPECT_LT(sum / static_cast<double>(found.samples.size()), 0.1);
}

TEST_F(ItkLevelSetTest, GrowsAndShrinksABallByTheFrontsSpeed) {
  const Volume start = ball_distance(6);
  Volume speed = start;
  std::fill(speed.samples.begin(), speed.samples.end(), 1.0f);
  // The step in time is 1 / 6 of a voxel over the weight: 12 of them move the front by two voxels.
  const EvolutionResult grown = evolved(start, speed, {1, 0, 0, 12, 1e-9}, {});
  EXPECT_NEAR(radius_of(grown.level_set), 8, 0.25);
  EXPECT_EQ(grown.iterations, 12);
  EXPECT_FALSE(grown.converged);
  EXPECT_GT(grown.rms_change, 0.5);
  // Under its mean curvature r' = -2 / r: r^2 falls by 4 t, t = 18 / 6.
  const EvolutionResult curved = evolved(start, speed, {0, 1, 0, 18, 1e-9}, {});
  EXPECT_NEAR(radius_of(curved.level_set), std::sqrt(36 - 4 * 3.0), 0.3);
}

TEST_F(ItkLevelSetTest, ConvergesWhereTheSpeedIsZero) {
  const Volume start = ball_distance(6);
  Volume speed = start;
  std::fill(speed.samples.begin(), speed.samples.end(), 0.0f);
  const EvolutionResult result = evolved(start, speed, {1, 1, 1, 1000, 0.01}, {});
  EXPECT_TRUE(result.converged);
  EXPECT_LE(result.iterations, 40);
  EXPECT_NEAR(radius_of(result.level_set), 6, 0.1);
}

TEST(HaveItk, IsWhatTheDoorSays) { EXPECT_EQ(have_itk(), has_geodesic_contour()); }

}  // namespace
}  // namespace mesamis
