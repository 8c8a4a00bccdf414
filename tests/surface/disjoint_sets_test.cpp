// SPDX-License-Identifier: Apache-2.0
#include "mesamis/surface/disjoint_sets.h"

#include <gtest/gtest.h>

namespace mesamis {
namespace {

TEST(DisjointSets, AreNamedByTheirSmallestItem) {
  DisjointSets sets(6);
  sets.unite(5, 3);
  sets.unite(4, 5);
  sets.unite(1, 2);
  for (const std::size_t item : {3u, 4u, 5u}) EXPECT_EQ(sets.find(item), 3u);
  EXPECT_EQ(sets.find(2), 1u);
  EXPECT_EQ(sets.find(0), 0u);
}

TEST(DisjointSets, AreNumberedInTheOrderOfTheirFirstItems) {
  DisjointSets sets(7);
  sets.unite(6, 2);
  sets.unite(5, 0);
  sets.unite(4, 6);
  const DisjointSets::Numbers numbers = sets.numbers();
  EXPECT_EQ(numbers.of_item, (std::vector<Index>{0, 1, 2, 3, 2, 0, 2}));
  EXPECT_EQ(numbers.count, 4);
  EXPECT_EQ(DisjointSets(0).numbers().count, 0);
}

}  // namespace
}  // namespace mesamis
