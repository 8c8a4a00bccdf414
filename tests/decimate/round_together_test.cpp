// SPDX-License-Identifier: Apache-2.0
#include "mesamis/decimate/round_together.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <random>
#include <tuple>

#include "mesamis/decimate/round_to_single.h"
#include "support/shapes.h"
#include "support/throws.h"

namespace mesamis {
namespace {

using testing::HasSubstr;

std::tuple<double, double, double> key(const Vec3& p) { return {p.x, p.y, p.z}; }

/// Far from zero, where many points share the nearest single precision number; half of them twice.
std::vector<Vec3> crowd(unsigned seed) {
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> uniform(0, 0.03);
  std::vector<Vec3> points;
  for (int i = 0; i < 200; ++i) {
    points.push_back({1e5 + uniform(generator), -1e5 + uniform(generator), 5});
    if (i % 2 == 0) points.push_back(points[points.size() / 2]);
  }
  return points;
}

TEST(RoundTogether, KeepsEqualPointsEqualAndDifferentOnesDifferent) {
  const std::vector<Vec3> points = crowd(1), result = round_together(points);
  ASSERT_EQ(result.size(), points.size());
  for (std::size_t a = 0; a < points.size(); ++a) {
    for (std::size_t b = 0; b < a; ++b) {
      ASSERT_EQ(points[a] == points[b], result[a] == result[b]) << a << ' ' << b;
    }
  }
}

TEST(RoundTogether, TellsInPlaceHowFarAPointMoved) {
  const std::vector<Vec3> before = crowd(4);
  std::vector<Vec3> points = before;
  const double most = round_in_place(points);
  EXPECT_EQ(points, round_together(before));
  double found = 0;
  for (std::size_t p = 0; p < points.size(); ++p) {
    found = std::max(found, norm(points[p] - before[p]));
  }
  EXPECT_GT(found, 0);
  EXPECT_EQ(most, found);
  EXPECT_EQ(round_in_place(points), 0) << "they are rounded";
}

TEST(RoundTogether, GivesSinglePrecisionNearThePoint) {
  const std::vector<Vec3> points = crowd(2), result = round_together(points);
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_EQ(static_cast<double>(static_cast<float>(result[i][axis])), result[i][axis]);
    }
    // 300 points share 5 x 5 of the numbers, which are 1/128 mm apart; they find room around.
    EXPECT_LT(norm(result[i] - points[i]), 12.0 / 128);
  }
  const Vec3 zero = round_together(std::vector<Vec3>{{-1e-300, -0.0, 0}})[0];
  EXPECT_FALSE(std::signbit(zero.x) || std::signbit(zero.y));
}

TEST(RoundTogether, WhereAPointGoesDoesNotDependOnTheOrder) {
  std::vector<Vec3> points = crowd(3);
  std::map<std::tuple<double, double, double>, Vec3> expected;
  const std::vector<Vec3> result = round_together(points);
  for (std::size_t i = 0; i < points.size(); ++i) expected[key(points[i])] = result[i];
  std::reverse(points.begin(), points.end());
  const std::vector<Vec3> again = round_together(points);
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_EQ(again[i], expected[key(points[i])]);
  }
}

/// Two cubes with a common face, and a point of one so near the other's that both round to one
/// place: each cube alone would be rounded in its own way.
TEST(RoundTogether, NeighboursStillShareTheirFaceAndStayClosed) {
  const TriMesh left = cube({4096, 0, 0}, 1), right = cube({4097, 0, 0}, 1e-5);
  std::vector<Vec3> points = left.points;
  points.insert(points.end(), right.points.begin(), right.points.end());
  const std::vector<Vec3> result = round_together(points);
  EXPECT_EQ(result[1], result[8]) << "the corner that both have";
  const TriMesh alone = round_to_single(right);
  EXPECT_LT(alone.points.size(), 8u) << "alone, points are joined";
  const TriMesh rounded{{result.begin() + 8, result.end()}, right.triangles};
  const SurfaceCheck check = check_surface(rounded);
  EXPECT_TRUE(check.closed() && check.manifold());
  std::map<std::tuple<double, double, double>, int> places;
  for (const Vec3& p : rounded.points) ++places[key(p)];
  EXPECT_EQ(places.size(), 8u);
}

TEST(RoundTogether, RefusesWhatSinglePrecisionCannotHold) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double bad : {1e39, -1e39, nan, std::numeric_limits<double>::infinity()}) {
    EXPECT_REFUSED(round_together(std::vector<Vec3>{{0, 0, 0}, {0, bad, 0}}),
                   HasSubstr("point 1: expected coordinates below 1e38"));
  }
  EXPECT_TRUE(round_together({}).empty());
}

}  // namespace
}  // namespace mesamis
