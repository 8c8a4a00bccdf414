// SPDX-License-Identifier: Apache-2.0
#include "mesamis/fit/terraces.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "fit/rough_ball.h"
#include "mesamis/base/parallel.h"

namespace mesamis {
namespace {

constexpr double kSlice = 2.5;
constexpr Index kSide = 60;  // of a square patch, mm

VoxelGrid grid_of_slices(double slice) {
  return {.size = {kSide + 5, kSide + 5, 40}, .spacing = {1, 1, slice}};
}

/// A height over each place of the patch.
TriMesh patch(const std::function<double(double, double)>& height) {
  TriMesh surface;
  for (Index y = 0; y <= kSide; ++y) {
    for (Index x = 0; x <= kSide; ++x) surface.points.push_back({x + 2.0, y + 2.0, height(x, y)});
  }
  for (Index y = 0; y < kSide; ++y) {
    for (Index x = 0; x < kSide; ++x) {
      const Index p = y * (kSide + 1) + x, q = p + kSide + 1;
      surface.triangles.push_back({p, p + 1, q + 1});
      surface.triangles.push_back({p, q + 1, q});
    }
  }
  return surface;
}

std::vector<Vec3> levelled(const TriMesh& surface, double slice = kSlice) {
  const VoxelGrid grid = grid_of_slices(slice);
  const std::size_t n = surface.points.size();
  const Springs springs{std::vector<double>(n, 1), {}, std::vector<char>(n, 0)};
  return without_terraces(SurfaceSpace(grid, 1), surface, Neighbors(surface), springs);
}

/// What slices make of a height: flat in the middle between two of them, steep at their planes.
double in_steps(double height) {
  return height + 0.12 * kSlice * std::sin(2 * std::numbers::pi * height / kSlice);
}

/// A slope of a large hill, of curvature radii of 100 mm and more.
double hill(double x, double y) {
  return 70 - (std::pow(x + 20, 2) + 0.5 * std::pow(y - 30, 2)) / 200;
}

/// Away from the rim of the patch.
double rms_to(const std::vector<Vec3>& points,
              const std::function<double(double, double)>& height) {
  constexpr double kRim = 5;
  double sum = 0, count = 0;
  for (const Vec3& p : points) {
    const double x = p.x - 2, y = p.y - 2;
    if (std::min({x, y, kSide - x, kSide - y}) < kRim) continue;
    sum += std::pow(p.z - height(x, y), 2);
    ++count;
  }
  return std::sqrt(sum / count);
}

TEST(Terraces, GoFromAHillOfThickSlices) {
  const TriMesh surface = patch([](double x, double y) { return in_steps(hill(x, y)); });
  const double before = rms_to(surface.points, hill);
  EXPECT_GT(before, 0.15);
  EXPECT_LT(rms_to(levelled(surface), hill), before / 3);
}

TEST(Terraces, AHillWithoutStays) { EXPECT_LT(rms_to(levelled(patch(hill)), hill), 0.02); }

/// Bending that levels terraces of ten edges would round it off by a slice.
TEST(Terraces, ARidgeLosesLessThanAFifthOfASlice) {
  // The crest lies midway between two slices: there it is held by nothing but its edge.
  const TriMesh ridge = patch([](double x, double) { return 20.5 * kSlice - std::abs(x - 30); });
  const std::vector<Vec3> level = levelled(ridge);
  double most = 0;
  for (std::size_t p = 0; p < level.size(); ++p) {
    const Vec3& at = ridge.points[p];
    if (at.x != 32 || at.y < 10 || at.y > kSide - 6) continue;  // away from the rim
    most = std::max(most, std::abs(level[p].z - at.z));
  }
  EXPECT_LT(most, kSlice / 5);
  EXPECT_GT(most, 0);
}

TEST(Terraces, ASmallBallKeepsItsSize) {
  const TriMesh ball = moved(ball_surface(6, 40), {30, 30, 50});
  const double volume = check_surface(ball).volume;
  EXPECT_NEAR(check_surface({levelled(ball), ball.triangles}).volume / volume, 1, 0.01);
}

TEST(Terraces, NoPointMovesFartherThanTwoFifthsOfASlice) {
  const TriMesh rough =
      patch([](double x, double y) { return hill(x, y) + 3 * std::sin(x) * std::sin(y); });
  const std::vector<Vec3> level = levelled(rough);
  for (std::size_t p = 0; p < level.size(); ++p) {
    ASSERT_LE(norm(level[p] - rough.points[p]), 0.4 * kSlice + 1e-9);
  }
}

TEST(Terraces, AreNotLookedForWhereSlicesAreAsThickAsPixels) {
  const TriMesh surface = patch([](double x, double y) { return in_steps(hill(x, y)) / 2.5; });
  EXPECT_EQ(levelled(surface, 1), surface.points);
  const VoxelGrid cubes = grid_of_slices(1), slices = grid_of_slices(1.2);
  EXPECT_FALSE(SurfaceSpace(cubes, 1).has_thick_slices());
  EXPECT_TRUE(SurfaceSpace(slices, 1).has_thick_slices());
}

TEST(Terraces, TheDistanceIsThatToTheThickSlicesAlone) {
  const VoxelGrid grid = grid_of_slices(kSlice);
  const SurfaceSpace space(grid, 1);
  EXPECT_NEAR(space.between_slices({4.5, 7.5, 3 * kSlice}, {0, 0, 1}), 0, 1e-12);
  EXPECT_NEAR(space.between_slices({4.5, 7.5, 3.5 * kSlice}, {0, 0, 1}), kSlice, 1e-12);
  EXPECT_NEAR(space.between_slices({4.5, 7.5, 3.5 * kSlice}, {0, 0.6, 0.8}), 0.64 * kSlice, 1e-12);
  EXPECT_NEAR(space.between_slices({4.5, 7.5, 3.5 * kSlice}, {1, 0, 0}), 0, 1e-12);
}

TEST(Terraces, GoWithTheSameBitsForAnyNumberOfThreads) {
  const TriMesh surface = patch([](double x, double y) { return in_steps(hill(x, y)); });
  const auto run = [&] { return levelled(surface); };
  EXPECT_EQ(with_threads(1, run), with_threads(3, run));
}

}  // namespace
}  // namespace mesamis
