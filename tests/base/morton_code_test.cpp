// SPDX-License-Identifier: Apache-2.0
#include "mesamis/base/morton_code.h"

#include <gtest/gtest.h>

#include <cstdint>

namespace mesamis {
namespace {

const Box kBox{{-1, 2, 5}, {3, 4, 9}};

TEST(MortonCode, InterleavesTheBitsOfTheCoordinates) {
  EXPECT_EQ(spread_bits(0b1011), 0b1000001001U);
  EXPECT_EQ(morton_code(kBox, kBox.lo), 0U);
  EXPECT_EQ(morton_code(kBox, kBox.hi), (std::uint64_t{1} << 63U) - 1);
  EXPECT_EQ(morton_code(kBox, {3, 2, 5}), spread_bits(0x1fffff));
  EXPECT_EQ(morton_code(kBox, {-1, 2, 9}), spread_bits(0x1fffff) << 2U);
}

TEST(MortonCode, GoesThroughEachHalfOfTheBoxBeforeTheOther) {
  const double middle = 0.5 * (kBox.lo.z + kBox.hi.z);
  for (double x = -1; x <= 3; x += 0.25) {
    for (double y = 2; y <= 4; y += 0.25) {
      EXPECT_LT(morton_code(kBox, {x, y, middle - 0.01}), morton_code(kBox, {x, y, middle + 0.01}));
      EXPECT_LT(morton_code(kBox, {3, 4, middle - 0.01}), morton_code(kBox, {x, y, middle + 0.01}));
    }
  }
}

TEST(MortonCode, LeavesOutSidesWithoutLength) {
  const Box flat{{0, 0, 1}, {1, 1, 1}};
  EXPECT_EQ(morton_code(flat, {0, 0, 1}), 0U);
  EXPECT_EQ(morton_code(flat, {1, 1, 1}), spread_bits(0x1fffff) | spread_bits(0x1fffff) << 1U);
}

}  // namespace
}  // namespace mesamis
