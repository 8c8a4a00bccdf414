// SPDX-License-Identifier: Apache-2.0
#include "mesamis/surface/list_materials.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "mesamis/base/parallel.h"
#include "mesamis/surface/neighbours.h"
#include "support/label_grids.h"

namespace mesamis {
namespace {

GridMemberships listed(const OwnedLabels& labels) {
  GridMemberships grid = parts_of(labels);
  list_materials(grid);
  return grid;
}

TEST(ListMaterials, ListsTheOwnFirstAndThoseOfTheNeighbours) {
  const GridMemberships grid = listed(random_blobs(20, 6, 8));
  for (std::size_t n = 0; n < grid.material.size(); ++n) {
    std::set<Index> expected{grid.material[n]};
    const Neighbours around(grid.size, static_cast<Index>(n));
    for (std::size_t i = 0; i < 14; ++i) {
      if (around[i] != kNoIndex) expected.insert(grid.material[around[i]]);
    }
    const auto begin = grid.listed.begin() + grid.first[n];
    const auto end = grid.listed.begin() + grid.first[n + 1];
    if (expected.size() == 1) {
      EXPECT_EQ(begin, end) << n;
    } else {
      EXPECT_EQ(std::set<Index>(begin, end), expected) << n;
      EXPECT_EQ(end - begin, std::ssize(expected)) << "each once";
      EXPECT_EQ(*begin, grid.material[n]);
    }
  }
}

TEST(ListMaterials, HasAValueOfNothingForEach) {
  const GridMemberships grid = listed(random_blobs(9, 3, 1));
  ASSERT_FALSE(grid.listed.empty());
  EXPECT_EQ(grid.value, std::vector<float>(grid.listed.size(), 0));
}

TEST(ListMaterials, IsEmptyForOneMaterial) {
  const GridMemberships grid =
      listed(labels_where({5, 4, 3}, {1, 1, 1}, [](const Vec3&) { return 4; }));
  EXPECT_TRUE(grid.listed.empty());
  EXPECT_EQ(grid.first, std::vector<std::int64_t>(61, 0));
}

TEST(ListMaterials, IsTheSameForAnyNumberOfThreads) {
  const OwnedLabels labels = random_blobs(22, 7, 3);
  const auto one = with_threads(1, [&] { return listed(labels); });
  const auto two = with_threads(2, [&] { return listed(labels); });
  EXPECT_EQ(one.first, two.first);
  EXPECT_EQ(one.listed, two.listed);
}

}  // namespace
}  // namespace mesamis
