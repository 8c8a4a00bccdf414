// SPDX-License-Identifier: Apache-2.0
#include "mesamis/phantom/implicit_shapes.h"

#include <gtest/gtest.h>

#include <random>

namespace mesamis {
namespace {

class RandomPoints : public ::testing::Test {
 protected:
  Vec3 next() { return {uniform_(generator_), uniform_(generator_), uniform_(generator_)}; }

 private:
  std::mt19937 generator_{1};
  std::uniform_real_distribution<double> uniform_{-10, 10};
};

TEST_F(RandomPoints, ATaperedCapsuleIsTheUnionOfItsBalls) {
  // Balls whose radius goes linearly from end to end: brute force.
  const Vec3 a{-4, 1, 0}, b{3, -2, 2};
  constexpr double ra = 3, rb = 1;
  for (int n = 0; n < 300; ++n) {
    const Vec3 p = next();
    double expected = -1e300;
    for (int i = 0; i <= 4000; ++i) {
      const double t = i / 4000.0;
      expected = std::max(expected, ball(p, a + t * (b - a), ra + t * (rb - ra)));
    }
    EXPECT_NEAR(tapered_capsule(p, {a, ra}, {b, rb}), expected, 2e-3);
  }
}

TEST_F(RandomPoints, ATaperedCapsuleOfOneRadiusIsACapsule) {
  const Vec3 a{-4, 1, 0}, b{3, -2, 2};
  for (int n = 0; n < 300; ++n) {
    const Vec3 p = next();
    EXPECT_NEAR(tapered_capsule(p, {a, 2}, {b, 2}), capsule(p, a, b, 2), 1e-12);
  }
}

TEST_F(RandomPoints, ARoundBoxIsASmallerBoxGrown) {
  // Outside, the distance to the box without its rounding, less the radius.
  const Vec3 half{5, 4, 3};
  constexpr double radius = 1.5;
  for (int n = 0; n < 1000; ++n) {
    const Vec3 p = next();
    Vec3 nearest;
    for (int a = 0; a < 3; ++a) nearest[a] = std::clamp(p[a], radius - half[a], half[a] - radius);
    const double outside = norm(p - nearest);
    if (outside == 0) {
      EXPECT_GE(round_box(p, half, radius), radius);
    } else {
      EXPECT_NEAR(round_box(p, half, radius), radius - outside, 1e-12);
    }
  }
}

TEST_F(RandomPoints, FilletsLieBetweenTheUnionAndAQuarterOfTheirWidthMore) {
  for (int n = 0; n < 1000; ++n) {
    const Vec3 p = next();
    const double a = p.x, b = p.y;
    constexpr double width = 4;
    EXPECT_GE(smooth_union(a, b, width), std::max(a, b));
    EXPECT_LE(smooth_union(a, b, width), std::max(a, b) + width / 4);
    EXPECT_EQ(smooth_intersection(a, b, width), -smooth_union(-a, -b, width));
    if (std::abs(a - b) >= width) {
      EXPECT_EQ(smooth_union(a, b, width), std::max(a, b));
    }
  }
}

TEST(SmoothStep, RisesFromZeroToOne) {
  EXPECT_EQ(smooth_step(-1, 0, 2), 0);
  EXPECT_EQ(smooth_step(1, 0, 2), 0.5);
  EXPECT_EQ(smooth_step(5, 0, 2), 1);
  constexpr double h = 1e-6;
  for (double x = -1; x < 3; x += 0.01) {
    const double slope = (smooth_step(x + h, 0, 2) - smooth_step(x - h, 0, 2)) / (2 * h);
    EXPECT_GE(slope, 0);
    EXPECT_LE(slope, 1.5 / 2 + 1e-6);
  }
}

}  // namespace
}  // namespace mesamis
