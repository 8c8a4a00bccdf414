// SPDX-License-Identifier: Apache-2.0
#include "mesamis/surface/triangle_intersection.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

namespace mesamis {
namespace {

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

using Lattice = std::array<std::int64_t, 3>;

/// Separating axes in integers: two triangles in space share a point if no normal and no cross
/// product of sides, and no normal in the plane, separates them strictly.
class ExactTriangles {
 public:
  explicit ExactTriangles(const std::array<Lattice, 6>& p) : p_(p) {}

  bool meet() const {
    const Lattice n = normal(0), m = normal(3);
    if (separates(n) || separates(m)) return false;
    for (std::size_t i = 0; i < 3; ++i) {
      const Lattice e = side(0, i), f = side(3, i);
      if (separates(cross_of(n, e)) || separates(cross_of(m, f))) return false;
      for (std::size_t j = 0; j < 3; ++j) {
        if (separates(cross_of(e, side(3, j)))) return false;
      }
    }
    return true;
  }

 private:
  static Lattice cross_of(const Lattice& a, const Lattice& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
  }
  Lattice side(std::size_t first, std::size_t i) const {
    const Lattice &a = p_[first + i], &b = p_[first + (i + 1) % 3];
    return {b[0] - a[0], b[1] - a[1], b[2] - a[2]};
  }
  Lattice normal(std::size_t first) const { return cross_of(side(first, 0), side(first, 1)); }

  bool separates(const Lattice& axis) const {
    std::array<std::int64_t, 6> x;
    for (std::size_t i = 0; i < 6; ++i) {
      x[i] = axis[0] * p_[i][0] + axis[1] * p_[i][1] + axis[2] * p_[i][2];
    }
    const auto [low, high] = std::minmax({x[0], x[1], x[2]});
    const auto [other_low, other_high] = std::minmax({x[3], x[4], x[5]});
    return high < other_low || other_high < low;
  }

  std::array<Lattice, 6> p_;
};

/// On a coarse lattice most pairs touch, are coplanar or just miss each other.
TEST(Intersect, AgreesWithIntegerSeparatingAxes) {
  std::mt19937 generator(5);
  for (const int width : {2, 4, 30}) {
    std::uniform_int_distribution<int> lattice(0, width);
    int met = 0, tried = 0;
    while (tried < 4000) {
      std::array<Lattice, 6> p;
      std::vector<Vec3> points;
      for (Lattice& q : p) {
        q = {lattice(generator), lattice(generator), lattice(generator)};
        // Scaled and shifted without rounding: the answer stays.
        points.push_back({1000 + 0.125 * double(q[0]), 0.125 * double(q[1]), 0.125 * double(q[2])});
      }
      const Triangle s{0, 1, 2}, t{3, 4, 5};
      if (!has_area(points, s) || !has_area(points, t)) continue;
      ++tried;
      const bool expected = ExactTriangles(p).meet();
      met += expected;
      ASSERT_EQ(meet(points, s, t), expected);
    }
    EXPECT_GT(met, 200);
    EXPECT_LT(met, 3900);
  }
}

TEST(Intersect, TrianglesWithoutAreaMeetNothing) {
  const std::vector<Vec3> p{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, 1, -1}, {1, 1, 1}, {1, 1, 0}};
  EXPECT_FALSE(meet(p, {0, 1, 2}, {3, 4, 5})) << "a segment that pierces";
  EXPECT_FALSE(meet(p, {0, 1, 2}, {3, 3, 4})) << "the same, of two points";
  for (const Triangle& t : {Triangle{0, 0, 1}, {0, 0, 0}, {1, 0, 1}}) {
    for (const Triangle& s : {Triangle{0, 1, 2}, {0, 0, 1}, {0, 3, 4}}) EXPECT_FALSE(meet(p, s, t));
  }
}

TEST(HasArea, SeesOneUnitInTheLastPlace) {
  const std::vector<Vec3> p{{1e6, 1e6, 1e6},
                            {1e6 + 1, 1e6 + 1, 1e6 + 1},
                            {1e6 + 7, 1e6 + 7, 1e6 + 7},
                            {1e6 + 7, 1e6 + 7, std::nextafter(1e6 + 7, 1e9)}};
  EXPECT_FALSE(has_area(p, {0, 1, 2}));
  EXPECT_TRUE(has_area(p, {0, 1, 3}));
  EXPECT_FALSE(has_area(p, {0, 0, 3}));
}

}  // namespace
}  // namespace mesamis
