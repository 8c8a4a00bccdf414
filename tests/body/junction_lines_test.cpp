// SPDX-License-Identifier: Apache-2.0
#include "mesamis/body/junction_lines.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "support/solids.h"

namespace mesamis {
namespace {

constexpr double kRadius = 10;

/// Two halves of a ball that share the disc at z = 0: three materials meet at its rim.
std::vector<TriMesh> two_halves() {
  const TriMesh upper = ball_above(0, kRadius, 48);
  return {upper, mirrored(upper)};
}

TEST(JunctionLines, OfTwoHalvesOfABallAreTheRimOfTheirDisc) {
  const JunctionLines lines(two_halves());
  EXPECT_EQ(lines.edges(), 48);
  for (int i = 0; i < 100; ++i) {
    const double turn = 0.1 * i;
    const auto found = lines.nearest(
        {0.9 * kRadius * std::cos(turn), 0.9 * kRadius * std::sin(turn), 0.3}, {0, 1, 2});
    ASSERT_TRUE(found);
    EXPECT_NEAR(found->point.z, 0, 1e-12);
    EXPECT_NEAR(norm(found->point), kRadius, 0.02 * kRadius);
    const Vec3 tangent{-std::sin(turn), std::cos(turn), 0};
    EXPECT_NEAR(std::abs(dot(found->direction, tangent)), 1, 0.02);
  }
}

TEST(JunctionLines, OfOtherMaterialsThereAreNone) {
  EXPECT_FALSE(JunctionLines(two_halves()).nearest({0, 0, 0}, {1, 2, 3}));
}

TEST(JunctionLines, ObjectsApartHaveNone) {
  const TriMesh ball = ball_surface(kRadius, 24);
  TriMesh other = ball;
  for (Vec3& p : other.points) p.x += 3 * kRadius;
  EXPECT_EQ(JunctionLines(std::vector{ball, other}).edges(), 0);
  EXPECT_EQ(JunctionLines(std::vector{ball}).edges(), 0);
}

/// Three sectors of a prism around the z axis, open at its ends: four materials meet at the axis'
/// ends, three along it, and three along each outer edge.
TEST(JunctionLines, OfThreeSectorsAreTheAxisAndThreeOuterEdges) {
  std::vector<TriMesh> sectors;
  const auto rim = [](int i, double z) {
    const double turn = 2 * std::acos(-1.0) * (i % 3) / 3;
    return Vec3{std::cos(turn), std::sin(turn), z};
  };
  for (int i = 0; i < 3; ++i) {
    TriMesh wedge;
    for (const double z : {0.0, 1.0}) {
      wedge.points.insert(wedge.points.end(), {Vec3{0, 0, z}, rim(i, z), rim(i + 1, z)});
    }
    wedge.triangles = {{0, 2, 1}, {3, 4, 5}, {0, 1, 4}, {0, 4, 3},
                       {1, 2, 5}, {1, 5, 4}, {0, 5, 2}, {0, 3, 5}};
    // The walls' diagonals run from the axis below to the rim above on both sides.
    sectors.push_back(wedge);
  }
  const JunctionLines lines(sectors);
  const auto axis = lines.nearest({0.1, 0.1, 0.4}, {1, 2, 3});
  ASSERT_TRUE(axis);
  EXPECT_NEAR(norm(axis->point - Vec3{0, 0, 0.4}), 0, 1e-12);
  EXPECT_NEAR(std::abs(axis->direction.z), 1, 1e-12);
  const auto outer = lines.nearest(1.2 * rim(1, 0.5), {0, 1, 2});
  ASSERT_TRUE(outer);
  EXPECT_NEAR(std::abs(outer->direction.z), 1, 1e-12);
}

}  // namespace
}  // namespace mesamis
