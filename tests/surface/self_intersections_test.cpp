// SPDX-License-Identifier: Apache-2.0
#include "mesamis/surface/self_intersections.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "mesamis/base/error.h"
#include "mesamis/base/parallel.h"
#include "mesamis/surface/triangle_intersection.h"
#include "support/level_set.h"
#include "support/shapes.h"

namespace mesamis {
namespace {

using Pairs = std::vector<std::array<Index, 2>>;

TEST(SelfIntersections, NoneInACubeOrALevelSet) {
  EXPECT_TRUE(find_self_intersections(cube()).empty());
  EXPECT_TRUE(find_self_intersections({}).empty());
  const TriMesh sphere = level_set({{-1, -1, -1}, {1, 1, 1}}, {12, 12, 12},
                                   [](const Vec3& p) { return 0.8 - norm(p); });
  EXPECT_TRUE(find_self_intersections(sphere).empty());
}

TEST(SelfIntersections, OfTwoCubes) {
  EXPECT_TRUE(find_self_intersections(joined(cube(), cube({3, 0, 0}))).empty());
  EXPECT_FALSE(find_self_intersections(joined(cube(), cube({0.3, 0.2, 0.1}))).empty());
  EXPECT_FALSE(find_self_intersections(joined(cube(), cube({1, 0, 0}))).empty());  // touch
  EXPECT_TRUE(find_self_intersections(joined(cube(), cube({1 + 1e-15, 0, 0}))).empty());
}

TEST(SelfIntersections, NameTrianglesWithoutArea) {
  TriMesh surface = cube();
  surface.points.push_back({10, 10, 10});
  surface.points.push_back({11, 11, 11});
  surface.points.push_back({13, 13, 13});
  surface.triangles.push_back({8, 9, 10});
  EXPECT_EQ(find_self_intersections(surface), (Pairs{{12, 12}}));
  surface.triangles.push_back(surface.triangles[3]);
  EXPECT_EQ(find_self_intersections(surface).front(), (std::array<Index, 2>{3, 13}));
}

TEST(SelfIntersections, AgreeWithBruteForce) {
  const TriMesh surface = random_triangles(300, {3, 3, 3});
  Pairs expected;
  for (Index s = 0; s < 300; ++s) {
    for (Index t = s + 1; t < 300; ++t) {
      if (intersect(surface.points, surface.triangles[s], surface.triangles[t])) {
        expected.push_back({s, t});
      }
    }
  }
  EXPECT_GT(expected.size(), 100u);
  EXPECT_EQ(find_self_intersections(surface), expected);
  with_threads(3, [&] { EXPECT_EQ(find_self_intersections(surface), expected); });
}

TEST(SelfIntersections, AreFoundAgainWhereTrianglesMove) {
  TriMesh surface = random_triangles(300, {3, 3, 3});
  SelfIntersections search(surface);
  const Pairs before = search.all();
  // Triangles of the random surface have no common points: the first hundred go elsewhere.
  std::vector<Index> moved;
  for (Index t = 0; t < 100; ++t) {
    moved.push_back(t);
    for (const Index p : surface.triangles[t])
      surface.points[p] = surface.points[p] + Vec3{1, 0, 0};
  }
  Pairs expected = find_self_intersections(surface);
  EXPECT_NE(expected, before);
  std::erase_if(expected, [](const TrianglePair& pair) { return pair[0] >= 100; });
  EXPECT_GT(expected.size(), 20u);
  EXPECT_EQ(search.after_move_of(moved), expected);
  with_threads(3, [&] { EXPECT_EQ(search.after_move_of(moved), expected); });
}

TEST(SelfIntersections, AreFoundAgainWhereAllPointsMove) {
  TriMesh surface = random_triangles(300, {3, 3, 3});
  SelfIntersections search(surface);
  surface.points = random_triangles(300, {4, 2, 3}).points;
  const Pairs expected = find_self_intersections(surface);
  EXPECT_GT(expected.size(), 100u);
  EXPECT_EQ(search.after_move(), expected);
}

TEST(TrianglesAt, HaveAChosenPoint) {
  const TriMesh surface = cube();
  for (Index p = 0; p < std::ssize(surface.points); ++p) {
    std::vector<char> chosen(surface.points.size(), 0);
    chosen[p] = 1;
    std::vector<Index> expected;
    for (Index t = 0; t < std::ssize(surface.triangles); ++t) {
      if (std::ranges::count(surface.triangles[t], p) > 0) expected.push_back(t);
    }
    EXPECT_EQ(triangles_at(surface.triangles, chosen), expected);
  }
}

TEST(SelfIntersections, RefuseWhatIsNoSurface) {
  EXPECT_THROW(find_self_intersections({{{0, 0, 0}}, {{0, 1, 2}}}), InputError);
}

}  // namespace
}  // namespace mesamis
