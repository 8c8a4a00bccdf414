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

TEST(Neighbours, OppositeOnesAreApart) {
  for (std::size_t i = 0; i < 7; ++i) EXPECT_EQ(count_parts(1U << i | 1U << (i + 7)), 2);
}

}  // namespace
}  // namespace mesamis
