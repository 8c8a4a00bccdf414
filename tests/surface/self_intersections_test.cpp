// SPDX-License-Identifier: Apache-2.0
#include "mesamis/surface/self_intersections.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "mesamis/base/error.h"
#include "mesamis/base/parallel.h"
#include "mesamis/surface/exact_predicates.h"
#include "mesamis/surface/triangle_intersection.h"
#include "support/level_set.h"
#include "support/shapes.h"

namespace mesamis {
namespace {

using Pairs = std::vector<std::array<Index, 2>>;

TEST(Orientation, SeesOneUnitInTheLastPlace) {
  // Coplanar in a tilted plane x + y + z = 3 * 2^k, then moved by one ulp.
  for (const double scale : {1.0, 0x1p-10, 0x1p12, 0x1p40}) {
    const Vec3 a{scale, scale, scale}, b{1.5 * scale, 0.5 * scale, scale};
    const Vec3 c{0.25 * scale, scale, 1.75 * scale};
    Vec3 d{0.5 * scale, 1.5 * scale, scale};
    EXPECT_EQ(orientation(a, b, c, d), 0);
    const int up = orientation(a, b, c, {2 * scale, 2 * scale, 2 * scale});
    EXPECT_NE(up, 0);
    d.x = std::nextafter(d.x, 1e300);
    EXPECT_EQ(orientation(a, b, c, d), up);
    d.x = std::nextafter(std::nextafter(d.x, 0), 0);
    EXPECT_EQ(orientation(a, b, c, d), -up);
  }
}

TEST(Orientation, ChangesSignWithEveryExchange) {
  std::mt19937 generator(1);
  // Points on a coarse lattice far away: many are coplanar.
  std::uniform_int_distribution<int> lattice(0, 3);
  auto point = [&] {
    return Vec3{1e8 + 0.1 * lattice(generator), 0.1 * lattice(generator),
                1e-5 * lattice(generator)};
  };
  int flat = 0;
  for (int i = 0; i < 5000; ++i) {
    const Vec3 a = point(), b = point(), c = point(), d = point();
    const int sign = orientation(a, b, c, d);
    flat += sign == 0;
    EXPECT_EQ(orientation(b, a, c, d), -sign);
    EXPECT_EQ(orientation(a, c, b, d), -sign);
    EXPECT_EQ(orientation(a, b, d, c), -sign);
    EXPECT_EQ(orientation(d, b, c, a), -sign);
  }
  EXPECT_GT(flat, 500);
}

TEST(OrientationAlong, SeesOneUnitInTheLastPlace) {
  const Vec3 a{0, 0.1, 0.1}, b{0, 0.2, 0.2}, c{0, 1e9, 1e9};
  EXPECT_EQ(orientation_along(0, a, b, c), 0);
  EXPECT_EQ(orientation_along(0, a, b, {0, 1e9, std::nextafter(1e9, 2e9)}), 1);
  EXPECT_EQ(orientation_along(0, a, b, {0, 1e9, std::nextafter(1e9, 0)}), -1);
}

/// Six points; two triangles named by index.
bool meet(const std::vector<Vec3>& points, const Triangle& s, const Triangle& t) {
  const bool answer = intersect(points, s, t);
  for (int turn = 0; turn < 3; ++turn) {
    for (int side = 0; side < 2; ++side) {
      Triangle a = s, b = t;
      std::rotate(a.begin(), a.begin() + turn, a.end());
      if (side) std::swap(b[0], b[1]);
      EXPECT_EQ(intersect(points, a, b), answer);
      EXPECT_EQ(intersect(points, b, a), answer);
    }
  }
  return answer;
}

TEST(Intersect, StrangersInSpace) {
  const Vec3 a{0, 0, 0}, b{4, 0, 0}, c{0, 4, 0};
  auto with = [&](const Vec3& d, const Vec3& e, const Vec3& f) {
    return meet({a, b, c, d, e, f}, {0, 1, 2}, {3, 4, 5});
  };
  EXPECT_TRUE(with({1, 1, -1}, {1, 1, 1}, {9, 9, 1}));       // pierces
  EXPECT_TRUE(with({1, 1, 0}, {1, 1, 1}, {2, 2, 1}));        // a corner on it
  EXPECT_FALSE(with({1, 1, 1e-300}, {1, 1, 1}, {2, 2, 1}));  // nearly on it
  EXPECT_TRUE(with({2, 2, -1}, {2, 2, 1}, {9, 9, 0}));       // touches the long side
  EXPECT_TRUE(with({0, 0, 0}, {-1, 0, 1}, {0, -1, 1}));      // corner on corner
  EXPECT_FALSE(with({5, 0, -1}, {5, 0, 1}, {9, 9, 0}));      // passes by
  EXPECT_FALSE(with({-9, -9, 1}, {9, -9, 1}, {-9, 20, 1}));  // parallel
}

TEST(Intersect, StrangersInAPlane) {
  const Vec3 a{0, 0, 5}, b{4, 0, 5}, c{0, 4, 5};
  auto with = [&](const Vec3& d, const Vec3& e, const Vec3& f) {
    return meet({a, b, c, d, e, f}, {0, 1, 2}, {3, 4, 5});
  };
  EXPECT_TRUE(with({1, 1, 5}, {1.5, 1, 5}, {1, 1.5, 5}));    // inside
  EXPECT_TRUE(with({-9, -9, 5}, {20, -9, 5}, {-9, 20, 5}));  // around
  EXPECT_TRUE(with({-1, 1, 5}, {5, 1, 5}, {-1, 2, 5}));      // across
  EXPECT_TRUE(with({4, 0, 5}, {8, 0, 5}, {8, 4, 5}));        // a corner
  EXPECT_TRUE(with({1, 0, 5}, {3, 0, 5}, {2, -1, 5}));       // a part of a side
  EXPECT_FALSE(with({5, 0, 5}, {8, 0, 5}, {8, 4, 5}));
}

TEST(Intersect, NeighboursMayMeetAtWhatTheyShareOnly) {
  const std::vector<Vec3> p{{0, 0, 0}, {4, 0, 0},  {0, 4, 0},  {4, 4, 0},  {1, 1, 0},
                            {2, 2, 1}, {2, 2, -1}, {-4, 0, 0}, {0, -4, 0}, {1, 1, 3}};
  EXPECT_FALSE(meet(p, {0, 1, 2}, {1, 3, 2}));  // across a side
  EXPECT_FALSE(meet(p, {0, 1, 2}, {1, 2, 9}));  // a steep one
  EXPECT_TRUE(meet(p, {0, 1, 2}, {0, 1, 4}));   // folded onto it
  EXPECT_TRUE(meet(p, {0, 1, 2}, {2, 1, 4}));
  EXPECT_FALSE(meet(p, {0, 1, 2}, {0, 7, 8}));  // fans in one plane, apart
  EXPECT_FALSE(meet(p, {0, 1, 2}, {0, 3, 4}));  // no area
}

TEST(Intersect, FansThatMeetBeyondTheirCorner) {
  const std::vector<Vec3> p{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, 1, 1}, {1, 1, -1},
                            {3, 1, 0}, {1, 3, 0}, {5, 5, 1}, {5, 5, -1}};
  EXPECT_TRUE(meet(p, {0, 1, 2}, {0, 3, 4}));  // ends within
  EXPECT_TRUE(meet(p, {0, 1, 2}, {0, 7, 8}));  // reaches across
  EXPECT_TRUE(meet(p, {0, 1, 2}, {0, 5, 6}));  // in the plane, within
  EXPECT_FALSE(meet(p, {0, 1, 7}, {0, 2, 8}));
}

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
  set_thread_count(3);
  EXPECT_EQ(find_self_intersections(surface), expected);
  set_thread_count(0);
}

TEST(SelfIntersections, RefuseWhatIsNoSurface) {
  EXPECT_THROW(find_self_intersections({{{0, 0, 0}}, {{0, 1, 2}}}), InputError);
}

}  // namespace
}  // namespace mesamis
