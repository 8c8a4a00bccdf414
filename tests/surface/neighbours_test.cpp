// SPDX-License-Identifier: Apache-2.0
#include "mesamis/surface/neighbours.h"

#include <gtest/gtest.h>

#include <bit>

namespace mesamis {
namespace {

TEST(Neighbours, OfANodeAreASphere) { EXPECT_EQ(count_parts(kAllNeighbours), 1); }

TEST(Neighbours, SetsHaveNoMorePartsThanNeighboursAndGainAtMostOneWithEach) {
  EXPECT_EQ(count_parts(0), 0);
  for (unsigned set = 0; set <= kAllNeighbours; ++set) {
    const Index parts = count_parts(set);
    ASSERT_LE(parts, std::popcount(set));
    ASSERT_GE(parts, set == 0 ? 0 : 1);
    for (std::size_t i = 0; i < 14; ++i) ASSERT_LE(count_parts(set | 1U << i), parts + 1);
  }
}

/// A node that stands alone adds a part, one between two parts joins them, and one in a cavity fills
/// that.
TEST(Neighbours, TellTheChangeOfTheEulerCharacteristic) {
  EXPECT_EQ(euler_change(0), 1);
  EXPECT_EQ(euler_change(kAllNeighbours), -1);
  for (std::size_t i = 0; i < 14; ++i) {
    EXPECT_EQ(euler_change(1U << i), 0) << "it grows";
    EXPECT_EQ(euler_change(kAllNeighbours & ~(1U << i)), 0) << "a dent is filled";
  }
  for (std::size_t i = 0; i < 7; ++i) EXPECT_EQ(euler_change(1U << i | 1U << (i + 7)), -1);
}

TEST(Neighbours, OfAKindAreThoseThatThereAre) {
  const std::array<Index, 3> size{3, 3, 3};
  EXPECT_EQ(Neighbours(size, 13).set_of([](Index) { return true; }), kAllNeighbours);
  EXPECT_EQ(Neighbours(size, 13).set_of([](Index) { return false; }), 0U);
  EXPECT_EQ(std::popcount(Neighbours(size, 0).set_of([](Index) { return true; })), 7);
}

TEST(Neighbours, OppositeOnesAreApart) {
  for (std::size_t i = 0; i < 7; ++i) EXPECT_EQ(count_parts(1U << i | 1U << (i + 7)), 2);
}

}  // namespace
}  // namespace mesamis
