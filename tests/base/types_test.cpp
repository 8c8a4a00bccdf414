// SPDX-License-Identifier: Apache-2.0
#include "mesamis/base/types.h"

#include <gtest/gtest.h>

#include <limits>

#include "support/expect_near.h"

namespace mesamis {
namespace {

constexpr Sym3 kMatrix{5, 1, 0.5, 3, -0.2, 2};
constexpr Vec3 kA{1, -2, 0.5}, kB{3, 0.25, -1};

TEST(Vec3, CrossProductIsOrthogonalToBoth) {
  const Vec3 c = cross(kA, kB);
  EXPECT_NEAR(dot(c, kA), 0, 1e-14);
  EXPECT_NEAR(dot(c, kB), 0, 1e-14);
  // Lagrange's identity.
  EXPECT_NEAR(dot(c, c), dot(kA, kA) * dot(kB, kB) - dot(kA, kB) * dot(kA, kB), 1e-12);
}

TEST(Sym3, QuadraticFormIsTheProductWithTheMatrix) {
  EXPECT_NEAR(quadratic_form(kMatrix, kA), dot(kA, kMatrix * kA), 1e-14);
  EXPECT_NEAR(dot(kB, kMatrix * kA), dot(kA, kMatrix * kB), 1e-14);
  EXPECT_NEAR(quadratic_form(outer(kB), kA), dot(kA, kB) * dot(kA, kB), 1e-14);
}

TEST(Sym3, DeterminantIsTheVolumeOfItsColumns) {
  const Vec3 x = kMatrix * Vec3{1, 0, 0}, y = kMatrix * Vec3{0, 1, 0}, z = kMatrix * Vec3{0, 0, 1};
  EXPECT_NEAR(determinant(kMatrix), dot(x, cross(y, z)), 1e-13);
  EXPECT_EQ(trace(kMatrix), x.x + y.y + z.z);
}

TEST(Mat3, TransposeTurnsARotationBack) {
  const double c = 0.6, s = 0.8;
  const Mat3 turn{{Vec3{c, -s, 0}, Vec3{s, c, 0}, Vec3{0, 0, 1}}};
  expect_near(transpose(turn) * (turn * kA), kA, 1e-15);
  EXPECT_NEAR(determinant(turn), 1, 1e-15);
  EXPECT_EQ(transpose(transpose(turn)), turn);
}

TEST(Box, HoldsItsFacesAndNothingThatIsNoNumber) {
  const Box box{{0, 0, 0}, {1, 2, 3}};
  EXPECT_EQ(box.volume(), 6);
  EXPECT_TRUE(box.contains({1, 2, 3}));
  EXPECT_TRUE(box.contains({0, 0, 0}));
  EXPECT_FALSE(box.contains({1.0001, 1, 1}));
  EXPECT_FALSE(box.contains({std::numeric_limits<double>::quiet_NaN(), 1, 1}));
}

TEST(PerpendicularTo, IsAcrossAndOfUnitLength) {
  for (const Vec3& n : {Vec3{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0.6, 0, 0.8}, {0.48, -0.6, 0.64}}) {
    EXPECT_NEAR(dot(perpendicular_to(n), n), 0, 1e-15);
    EXPECT_NEAR(norm(perpendicular_to(n)), 1, 1e-15);
  }
  EXPECT_EQ(perpendicular_to({0, 0, 0}), (Vec3{0, 0, 0}));
}

}  // namespace
}  // namespace mesamis
