// SPDX-License-Identifier: Apache-2.0
#include "mesamis/image/grid_axes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "support/throws.h"

namespace mesamis {
namespace {

using testing::HasSubstr;

TEST(GridAxes, OfStepsAlongTheWorldAreExact) {
  const GridAxes axes = grid_axes({Vec3{-0.7, 0, 0}, Vec3{0, -0.8, -0.0}, Vec3{0, 0, 2.5}});
  EXPECT_EQ(axes.spacing, (Vec3{0.7, 0.8, 2.5}));
  EXPECT_EQ(axes.direction, (Mat3{{Vec3{-1, 0, 0}, Vec3{0, -1, 0}, Vec3{0, 0, 1}}}));
  EXPECT_FALSE(std::signbit(axes.direction.rows[2].y));
  EXPECT_EQ(axes.skew, 0);
}

TEST(GridAxes, OfRoundedObliqueStepsAreOrthonormalAndKeepTheirHand) {
  const double c = std::cos(0.3), s = std::sin(0.3);
  for (const double hand : {1.0, -1.0}) {
    std::array<Vec3, 3> steps{Vec3{2 * c, 2 * s, 0}, Vec3{-s, c, 0}, Vec3{0, 0, 3 * hand}};
    for (Vec3& step : steps) {
      for (int a = 0; a < 3; ++a) step[a] = static_cast<float>(step[a]);
    }
    const GridAxes axes = grid_axes(steps);
    const Mat3 d = axes.direction, t = transpose(d);
    EXPECT_NEAR(determinant(d), hand, 1e-14);
    for (int a = 0; a < 3; ++a) {
      EXPECT_NEAR(norm(t.rows[static_cast<std::size_t>(a)]), 1, 1e-15);
      EXPECT_NEAR(
          dot(t.rows[static_cast<std::size_t>(a)], t.rows[static_cast<std::size_t>((a + 1) % 3)]),
          0, 1e-15);
    }
    EXPECT_NEAR(axes.spacing.x, 2, 1e-6);
    EXPECT_LT(axes.skew, 1e-6);
  }
}

TEST(GridAxes, RefuseWhatIsNoGrid) {
  const Vec3 x{1, 0, 0}, y{0, 1, 0};
  EXPECT_REFUSED(grid_axes({x, y, Vec3{0, 0, 0}}), HasSubstr("spacing along axis 2, found 0 mm"));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_REFUSED(grid_axes({x, Vec3{0, nan, 0}, y}), HasSubstr("along axis 1"));
  EXPECT_REFUSED(grid_axes({x, y, Vec3{0.01, 0, 1}}), HasSubstr("expected orthogonal voxel axes"));
  EXPECT_REFUSED(grid_axes({x, y, y}), HasSubstr("cosine of 1"));
}

}  // namespace
}  // namespace mesamis
