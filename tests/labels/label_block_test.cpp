// SPDX-License-Identifier: Apache-2.0
#include "mesamis/labels/label_block.h"

#include <gtest/gtest.h>

#include <numeric>

namespace mesamis {
namespace {

/// 10 x 8 x 6 voxels of 2 mm with the label 3 in a box of 2 x 2 x 2 and the label 5 at a corner.
LabelMap small_map() {
  LabelMap map;
  map.size = {10, 8, 6};
  map.spacing = {2, 2, 2};
  map.origin = {100, 0, 0};
  map.layers.assign(1, std::vector<std::uint16_t>(map.voxel_count(), 0));
  for (Index k = 2; k < 4; ++k) {
    for (Index j = 3; j < 5; ++j) {
      for (Index i = 4; i < 6; ++i) map.layers[0][map.offset(i, j, k)] = 3;
    }
  }
  map.layers[0][map.offset(0, 0, 0)] = 5;
  map.segments = {{"box", 3, 0, {}}, {"corner", 5, 0, {}}, {"nowhere", 6, 0, {}}};
  return map;
}

TEST(LabelBlock, LeavesRoomToAllSides) {
  const LabelMap map = small_map();
  const auto block = block_around(map, std::vector{map.segments[0]}, 3);
  ASSERT_TRUE(block.has_value());
  EXPECT_EQ(block->begin, (std::array<Index, 3>{4 - 6, 3 - 6, 2 - 6})) << "two voxels and four";
  EXPECT_EQ(block->size, (std::array<Index, 3>{14, 14, 14}));
  EXPECT_FALSE(block_around(map, std::vector{map.segments[2]}, 3).has_value());
}

TEST(LabelBlock, IsClippedToTheGrid) {
  const LabelMap map = small_map();
  const LabelBlock part = clipped(*block_around(map, std::vector{map.segments[0]}, 3), map);
  EXPECT_EQ(part.begin, (std::array<Index, 3>{0, 0, 0}));
  EXPECT_EQ(part.size, map.size);
  const LabelBlock flat = clipped({{9, 7, 5}, {1, 1, 1}}, map);
  EXPECT_EQ(flat.begin, (std::array<Index, 3>{8, 6, 4}));
  EXPECT_EQ(flat.size, (std::array<Index, 3>{2, 2, 2}));
}

TEST(LabelBlock, HoldsTheLabelsWhereTheyLieInTheWorld) {
  const LabelMap map = small_map();
  const LabelBlock block{{-2, -1, 0}, {8, 7, 5}};
  const VoxelGrid grid = grid_of(map, block);
  EXPECT_EQ(grid.origin.x, 96);
  EXPECT_EQ(grid.origin.y, -2);
  const auto labels = labels_in(map, 0, block);
  ASSERT_EQ(labels.size(), grid.voxel_count());
  EXPECT_EQ(labels[grid.offset(2, 1, 0)], 5);
  EXPECT_EQ(labels[grid.offset(6, 4, 2)], 3);
  EXPECT_EQ(labels[grid.offset(7, 5, 3)], 3);
  EXPECT_EQ(std::accumulate(labels.begin(), labels.end(), 0), 5 + 8 * 3);
}

TEST(LabelBlock, KeepsTheChosenLabels) {
  std::vector<std::uint16_t> labels{0, 3, 2, 3, 1};
  keep_chosen(std::vector<char>{0, 1, 0, 1}, labels);
  EXPECT_EQ(labels, (std::vector<std::uint16_t>{0, 3, 0, 3, 1}));
}

TEST(LabelBlock, OfAnySizeAndPlaceHoldsWhatIsThere) {
  const LabelMap map = small_map();
  for (Index begin = -6; begin < 12; ++begin) {
    for (const Index size : {1, 2, 3, 9}) {
      const LabelBlock block{{begin, begin, begin}, {size, size, size}};
      const auto labels = labels_in(map, 0, block);
      const VoxelGrid grid = grid_of(map, block);
      ASSERT_EQ(labels.size(), grid.voxel_count());
      for (Index i = 0; i < size; ++i) {  // along the diagonal
        const Index at = begin + i;
        const bool inside = at >= 0 && at < 6;
        EXPECT_EQ(labels[grid.offset(i, i, i)], inside ? map.layers[0][map.offset(at, at, at)] : 0);
      }
    }
  }
}

}  // namespace
}  // namespace mesamis
