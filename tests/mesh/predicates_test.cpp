// SPDX-License-Identifier: Apache-2.0
#include "mesamis/mesh/predicates.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace mesamis {
namespace {

/// Four points of which the last is a hair above or below the plane of the others.
std::array<Vec3, 4> nearly_flat(std::mt19937& generator) {
  std::uniform_real_distribution<double> uniform(-1, 1), power(-18, -8);
  auto point = [&] { return Vec3{uniform(generator), uniform(generator), uniform(generator)}; };
  const Vec3 a = point(), b = point(), c = point();
  const Vec3 on_plane = a + uniform(generator) * (b - a) + uniform(generator) * (c - a);
  const double side = uniform(generator) < 0 ? -1 : 1;
  return {a, b, c, on_plane + side * std::pow(10.0, power(generator)) * cross(b - a, c - a)};
}

bool is_even(const std::array<int, 4>& order) {
  int inversions = 0;
  for (int i = 0; i < 4; ++i) {
    for (int j = i + 1; j < 4; ++j) inversions += order[i] > order[j];
  }
  return inversions % 2 == 0;
}

TEST(Predicates, CertifiedInAnyOrderHoldsInEveryOrder) {
  std::mt19937 generator(7);
  int certified = 0, doubtful = 0;
  for (int trial = 0; trial < 20000; ++trial) {
    const auto p = nearly_flat(generator);
    if (certified_in_any_order(p[1] - p[0], p[2] - p[0], p[3] - p[0]) <= 0) {
      ++doubtful;
      continue;
    }
    ++certified;
    std::array<int, 4> order{0, 1, 2, 3};
    do {
      const bool positive = certified_positive(p[order[0]], p[order[1]], p[order[2]], p[order[3]]);
      ASSERT_EQ(positive, is_even(order));
    } while (std::next_permutation(order.begin(), order.end()));
  }
  EXPECT_GT(certified, 1000);
  EXPECT_GT(doubtful, 1000);
}

TEST(Predicates, FlatCellsAreNeverCertified) {
  std::mt19937 generator(8);
  std::uniform_int_distribution<int> integer(-1000, 1000);
  for (int trial = 0; trial < 2000; ++trial) {
    // Points of the plane z = 3 x - 7 y are exact.
    auto point = [&] {
      const double x = integer(generator), y = integer(generator);
      return Vec3{x, y, 3 * x - 7 * y};
    };
    const Vec3 a = point(), b = point(), c = point(), d = point();
    EXPECT_EQ(certified_six_volume(a, b, c, d), 0);
    EXPECT_EQ(certified_in_any_order(b - a, c - a, d - a), 0);
  }
}

TEST(Predicates, SixVolumeOfAUnitCorner) {
  EXPECT_EQ(certified_six_volume({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}), 1);
  EXPECT_EQ(certified_six_volume({0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {0, 0, 1}), 0);
  EXPECT_EQ(certified_in_any_order({1, 0, 0}, {0, 1, 0}, {0, 0, 1}), 1);
}

}  // namespace
}  // namespace mesamis
