// SPDX-License-Identifier: Apache-2.0
#include "mesamis/surface/farthest.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "surface/random_surfaces.h"

namespace mesamis {
namespace {

/// The farthest of the points of a triangular lattice with n steps on each side.
double sampled_distance(const Corners& t, const TriangleTree& tree, int n) {
  double farthest = 0;
  std::size_t hint = 0;
  for (int i = 0; i <= n; ++i) {
    for (int j = 0; i + j <= n; ++j) {
      const Vec3 p = t[0] + (double(i) / n) * (t[1] - t[0]) + (double(j) / n) * (t[2] - t[0]);
      farthest = std::max(farthest, tree.squared_distance_to(p, hint));
    }
  }
  return std::sqrt(farthest);
}

double longest_side(const Corners& t) {
  return std::max({norm(t[1] - t[0]), norm(t[2] - t[1]), norm(t[0] - t[2])});
}

/// The distance changes by no more than the way to the next sample.
TEST(Farthest, BoundsSamplesFromAboveAndWithinItsSlack) {
  constexpr int kSteps = 150;
  for (const Vec3& stretch : {Vec3{1, 1, 1}, Vec3{1000, 1, 1}, Vec3{1000, 1000, 1}}) {
    const TriMesh surface = random_triangles(80, stretch, 1),
                  others = random_triangles(4, stretch, 2);
    const TriangleTree tree(surface);
    std::size_t hint = 0;
    for (const Triangle& t : others.triangles) {
      const Corners corners = corners_of(others, t);
      const double sampled = sampled_distance(corners, tree, kSteps);
      const double below = 0.01 * sampled;
      const double found = farthest_distance(corners, tree, {below}, hint);
      EXPECT_GE(found, sampled * (1 - 1e-12));
      EXPECT_LE(found, kDistanceSlack * (sampled + longest_side(corners) / kSteps));
    }
  }
}

TEST(Farthest, OfAParallelTriangleIsTheDistanceOfThePlanes) {
  const TriMesh plane{{{-50, -50, 0}, {50, -50, 0}, {50, 50, 0}, {-50, 50, 0}},
                      {{0, 1, 2}, {0, 2, 3}}};
  const TriangleTree tree(plane);
  std::size_t hint = 0;
  const double found =
      farthest_distance({Vec3{-9, -7, 3}, {8, 1, 3}, {-2, 9, 3}}, tree, {1e-3}, hint);
  EXPECT_GE(found, 3);
  EXPECT_LE(found, 3 * kDistanceSlack);
}

/// Between two parallel walls the farthest points lie on the plane midway, far from all corners.
TEST(Farthest, LiesMidwayBetweenTwoWalls) {
  TriMesh walls{{{0, -90, -90}, {0, 90, -90}, {0, 0, 90}}, {{0, 1, 2}}};
  TriMesh other = walls;
  for (Vec3& p : other.points) p.x = 2;
  walls = joined(walls, other);
  const TriangleTree tree(walls);
  std::size_t hint = 0;
  const double found = farthest_distance({Vec3{0, 0, 0}, {2, 0, 0}, {0, 0, 1}}, tree, {1e-3}, hint);
  EXPECT_GE(found, 1);
  EXPECT_LE(found, kDistanceSlack);
}

TEST(Farthest, StopsAtWhatIsEnough) {
  const TriMesh plane{{{-9, -9, 0}, {9, -9, 0}, {0, 9, 0}}, {{0, 1, 2}}};
  const TriangleTree tree(plane);
  std::size_t hint = 0;
  const Corners near{Vec3{0, 0, 0.1}, {1, 0, 0.2}, {0, 1, 0.3}};
  EXPECT_NEAR(farthest_distance(near, tree, {0.5}, hint), 0.3, 1e-12);
  EXPECT_LE(farthest_distance(corners_of(plane, {0, 1, 2}), tree, {1e-6}, hint), 1e-6);
  const Corners steep{Vec3{0, 0, 1}, {1, 0, 5}, {0, 1, 9}};
  const double found = farthest_distance(steep, tree, {0.5, 2}, hint);
  EXPECT_GT(found, 2);  // far enough: it occurs, but need not be the greatest
  EXPECT_LE(found, 9 * kDistanceSlack);
}

}  // namespace
}  // namespace mesamis
