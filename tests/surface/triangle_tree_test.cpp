// SPDX-License-Identifier: Apache-2.0
#include "mesamis/surface/triangle_tree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "mesamis/mesh/tet_mesh.h"
#include "surface/random_surfaces.h"

namespace mesamis {
namespace {

TEST(SquaredDistance, IsRightInEachRegionOfATriangle) {
  const Corners triangle{Vec3{0, 0, 0}, Vec3{4, 0, 0}, Vec3{0, 4, 0}};
  const std::vector<std::pair<Vec3, double>> cases{
      {{1, 1, 3}, 9},  {{1, 1, -3}, 9},  {{-3, -4, 0}, 25}, {{-3, -4, 12}, 169},
      {{7, 0, 4}, 25}, {{2, -5, 0}, 25}, {{4, 4, 0}, 8},    {{-1, 2, 1}, 2},
      {{0, 9, 0}, 25}, {{1, 1, 0}, 0},   {{8, -3, 0}, 25}};
  for (const auto& [p, expected] : cases) {
    EXPECT_NEAR(squared_distance(p, triangle), expected, 1e-13) << p.x << ' ' << p.y << ' ' << p.z;
  }
}

TEST(SquaredDistance, ToATriangleWithoutAreaIsThatToItsEdges) {
  const Vec3 a{0, 0, 0}, b{10, 0, 0}, m{5, 0, 0};
  for (const Corners& t :
       {Corners{a, b, m}, Corners{b, m, a}, Corners{m, a, b}, Corners{a, a, b}}) {
    EXPECT_NEAR(squared_distance({5, 3, 4}, t), 25, 1e-13);
    EXPECT_NEAR(squared_distance({13, 4, 0}, t), 25, 1e-13);
  }
  EXPECT_NEAR(squared_distance({3, 4, 0}, {a, a, a}), 25, 1e-13);
}

TEST(NearestPlace, IsWhereTheDistanceIsMeasured) {
  const TriMesh surface = random_triangles(300, {1, 1, 1});
  for (const Triangle& k : surface.triangles) {
    const Corners t = corners_of(surface, k);
    for (const Vec3& p : random_points(20, {-3, -3, -3}, {3, 3, 3}, 12)) {
      const auto [a, b, c] = nearest_place(p, t);
      const double least = -1e-6;
      EXPECT_TRUE(a >= least && b >= least && c >= least) << a << ' ' << b << ' ' << c;
      EXPECT_NEAR(a + b + c, 1, 1e-6);
      const Vec3 way = p - (a * t[0] + b * t[1] + c * t[2]);
      EXPECT_NEAR(norm(way), std::sqrt(squared_distance(p, t)), 1e-5);
    }
  }
}

TEST(TriangleTree, FindsTheTrianglesWhoseBoxesOverlapAnother) {
  const TriMesh surface = random_triangles(300, {1, 1, 1});
  const TriangleTree tree(surface);
  for (const Vec3& p : random_points(20, {-3, -3, -3}, {3, 3, 3}, 12)) {
    const Box box{p - Vec3{0.3, 0.3, 0.3}, p + Vec3{0.3, 0.3, 0.3}};
    std::vector<char> found(surface.triangles.size(), 0);
    tree.for_each_overlap(box, [&](std::size_t hint) { found[tree.index_of(hint)] = 1; });
    for (std::size_t t = 0; t < found.size(); ++t) {
      if (overlap(box, bounding_box(corners_of(surface, surface.triangles[t])))) {
        EXPECT_EQ(found[t], 1);
      }
    }
  }
}

double nearest_of_all(const Vec3& p, const TriMesh& surface) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const Triangle& t : surface.triangles) {
    nearest = std::min(nearest, squared_distance(p, {surface.points[t[0]], surface.points[t[1]],
                                                     surface.points[t[2]]}));
  }
  return nearest;
}

TEST(TriangleTree, FindsTheNearestOfTrianglesOfEveryKind) {
  const TriMesh surface = mixed_triangles(3000);
  const TriangleTree tree(surface);
  std::size_t hint = 0;
  for (const Vec3& p : random_points(300, {-3, -3, -3}, {3, 3, 3}, 10)) {
    EXPECT_EQ(tree.squared_distance_to(p, hint), nearest_of_all(p, surface));
  }
}

TEST(TriangleTree, FindsTheNearestAtLengthRatiosOfAThousand) {
  for (const Vec3& stretch : {Vec3{1000, 1, 1}, Vec3{1, 1000, 1000}}) {
    const TriMesh surface = random_triangles(1000, stretch);
    const TriangleTree tree(surface);
    std::size_t hint = 0;
    for (const Vec3& p : random_points(200, -0.2 * stretch, 1.2 * stretch, 11)) {
      EXPECT_EQ(tree.squared_distance_to(p, hint), nearest_of_all(p, surface));
    }
  }
}

TEST(TriangleTree, TheHintChangesNoDistanceAndNamesTheNearestTriangle) {
  const TriMesh surface = random_triangles(500, {1, 1, 1});
  const TriangleTree tree(surface);
  std::size_t warm = 0;
  for (const Vec3& p : random_points(200, {-1, -1, -1}, {2, 2, 2}, 12)) {
    std::size_t cold = 0;
    const double distance = tree.squared_distance_to(p, warm);
    EXPECT_EQ(tree.squared_distance_to(p, cold), distance);
    EXPECT_EQ(squared_distance(p, tree.triangle(warm)), distance);
    EXPECT_EQ(squared_distance(p, tree.triangle(cold)), distance);
  }
}

TEST(TriangleTree, OfOneTriangleOrManyEqualOnes) {
  for (const std::size_t count : {1u, 1000u}) {
    const TriMesh surface{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}},
                          std::vector<Triangle>(count, {0, 1, 2})};
    std::size_t hint = 0;
    EXPECT_EQ(TriangleTree(surface).squared_distance_to({0.2, 0.2, 2}, hint), 4);
  }
}

}  // namespace
}  // namespace mesamis
