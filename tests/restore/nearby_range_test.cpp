// SPDX-License-Identifier: Apache-2.0
#include "mesamis/restore/nearby_range.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace mesamis {
namespace {

const std::array<Index, 3> kSize{23, 9, 30};

std::size_t place(Index i, Index j, Index k) {
  return static_cast<std::size_t>((k * kSize[1] + j) * kSize[0] + i);
}

template <class Visit>
void for_each_voxel(Visit&& visit) {
  for (Index k = 0; k < kSize[2]; ++k) {
    for (Index j = 0; j < kSize[1]; ++j) {
      for (Index i = 0; i < kSize[0]; ++i) visit(i, j, k);
    }
  }
}

TEST(NearbyRange, HoldsAllValuesWithinReach) {
  std::mt19937 generator(3);
  std::uniform_real_distribution<float> uniform(-5, 5);
  std::vector<float> values(place(0, 0, kSize[2]));
  for (float& value : values) value = uniform(generator);
  const std::array<double, 3> reach{0, 1.2, 7.9};
  const NearbyRange near(kSize, values, reach);
  for_each_voxel([&](Index i, Index j, Index k) {
    const auto [low, high] = near.at(i, j, k);
    for_each_voxel([&](Index x, Index y, Index z) {
      if (std::abs(x - i) > reach[0] || std::abs(y - j) > reach[1] || std::abs(z - k) > reach[2]) {
        return;
      }
      ASSERT_LE(low, values[place(x, y, z)]);
      ASSERT_GE(high, values[place(x, y, z)]);
    });
  });
}

TEST(NearbyRange, DoesNotSeeWhatIsFarAway) {
  std::vector<float> values(place(0, 0, kSize[2]), 1);
  values[place(2, 4, 3)] = 7;
  const NearbyRange near(kSize, values, {2, 2, 2});
  for_each_voxel([&](Index i, Index j, Index k) {
    EXPECT_EQ(near.at(i, j, k).low, 1);
    const Index apart = std::max({std::abs(i - 2), std::abs(j - 4), std::abs(k - 3)});
    if (apart <= 2 || apart > 2 + 8) {
      EXPECT_EQ(near.at(i, j, k).high, apart <= 2 ? 7 : 1);
    }
  });
}

}  // namespace
}  // namespace mesamis
