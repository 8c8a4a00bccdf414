// SPDX-License-Identifier: Apache-2.0
#include "mesamis/body/wall_width.h"

#include <gtest/gtest.h>

#include <cmath>

#include "mesamis/base/parallel.h"
#include "support/shapes.h"
#include "support/solids.h"

namespace mesamis {
namespace {

constexpr double kAnyWidth = 100;

std::vector<double> widths(const TriMesh& surface, Side side, double most = kAnyWidth) {
  return wall_widths(surface, SignedDistance(surface), side, most);
}

/// Of a plate from 0 to 20, 0 to 20 and z to z + thickness.
TriMesh plate(double z, double thickness) {
  return brick({{0, 0, z}, {20, 20, z + thickness}}, {10, 10, 1});
}

/// Farther from the sides of a plate than it is thick.
bool is_central(const Vec3& p) { return p.x > 3 && p.x < 17 && p.y > 3 && p.y < 17; }

TEST(WallWidth, OfAPlateIsItsThickness) {
  const TriMesh surface = plate(0, 2);
  const auto wall = widths(surface, Side::kWall);
  const auto gap = widths(surface, Side::kGap);
  int central = 0;
  for (std::size_t i = 0; i < wall.size(); ++i) {
    EXPECT_EQ(gap[i], INFINITY);
    if (!is_central(surface.points[i])) continue;
    EXPECT_NEAR(wall[i], 2, 1e-9);
    ++central;
  }
  EXPECT_GT(central, 50);
}

TEST(WallWidth, OfTheGapBetweenTwoPlatesIsTheirDistance) {
  const TriMesh surface = joined(plate(0, 2), plate(2.5, 3));
  const auto wall = widths(surface, Side::kWall);
  const auto gap = widths(surface, Side::kGap);
  for (std::size_t i = 0; i < gap.size(); ++i) {
    const Vec3& p = surface.points[i];
    if (!is_central(p)) continue;
    const bool faces_gap = p.z == 2 || p.z == 2.5;
    if (faces_gap) {
      EXPECT_NEAR(gap[i], 0.5, 1e-9);
    } else {
      EXPECT_EQ(gap[i], INFINITY);
    }
    EXPECT_NEAR(wall[i], p.z <= 2 ? 2 : 3, 1e-9);
  }
}

/// A ball's inside touches it everywhere: it has its diameter or, where the facets at its sides are
/// nearer than the opposite ones, none.
TEST(WallWidth, OfABallIsItsDiameterOrNone) {
  const TriMesh surface = ball_surface(5, 48);
  for (const double width : widths(surface, Side::kWall)) {
    if (width < INFINITY) {
      EXPECT_NEAR(width, 10, 0.1);
    }
  }
  for (const double width : widths(surface, Side::kGap)) EXPECT_EQ(width, INFINITY);
}

/// A ball inside a hollow ball: the gap between them is the same all around.
TEST(WallWidth, OfAHollowBallIsTheDifferenceOfTheRadii) {
  TriMesh hollow = ball_surface(5, 64);
  for (Triangle& t : hollow.triangles) std::swap(t[1], t[2]);
  const TriMesh surface = joined(ball_surface(8, 64), hollow);
  const auto wall = widths(surface, Side::kWall);
  for (const double width : wall) EXPECT_NEAR(width, 3, 0.15);
}

TEST(WallWidth, WiderOnesAreNotLookedFor) {
  const TriMesh surface = plate(0, 2);
  for (const double width : widths(surface, Side::kWall, 1.9))
    EXPECT_FALSE(width > 1.9 + 1e-9 && width < INFINITY);
  const auto wall = widths(surface, Side::kWall, 1.9);
  for (std::size_t i = 0; i < wall.size(); ++i) {
    if (is_central(surface.points[i])) {
      EXPECT_EQ(wall[i], INFINITY);
    }
  }
}

TEST(WallWidth, IsTheSameForAnyNumberOfThreads) {
  const TriMesh surface = joined(plate(0, 2), moved(ball_surface(5, 40), {10, 10, 8}));
  const auto once = with_threads(1, [&] { return widths(surface, Side::kGap); });
  EXPECT_EQ(with_threads(4, [&] { return widths(surface, Side::kGap); }), once);
}

}  // namespace
}  // namespace mesamis
