// SPDX-License-Identifier: Apache-2.0
#include "mesamis/surface/grid_field.h"

#include <gtest/gtest.h>

#include "support/random_memberships.h"
#include "support/throws.h"

namespace mesamis {
namespace {

TEST(GridField, KnowsTheNodesOfALargerGrid) {
  GridMemberships grid = random_grid({4, 3, 5}, 2, 1);
  grid.below = 7;
  grid.above = 0;
  const GridField field(grid, true);
  const Index node = 1 + 4 * (2 + 3 * 4);
  EXPECT_EQ(field.place(node), (std::array<Index, 3>{1, 2, 4}));
  EXPECT_EQ(field.point(node), (Vec3{1, 4, 5.5}));
  EXPECT_EQ(field.planes(node), 1U << 3U | 1U << 5U) << "the end of y, and of the whole grid";
  EXPECT_EQ(field.planes(0), 1U | 1U << 2U) << "not its bottom";
  EXPECT_EQ(GridField(grid, false).planes(0), 0U);
}

TEST(GridField, PartsAreNamedByLabelsAndNodesOfTheWhole) {
  GridMemberships grid = random_grid({4, 3, 5}, 3, 1);
  grid.label = {9, 4, 4};
  grid.below = 1 << 29;
  const PartitionPart part = named_wholly(
      grid, {{{1, 2, kNoIndex, kNoIndex}}, {{}, {{0, 1, 2}, {3, 4, 5}}, {{0, 1}, {2, kNoIndex}}}});
  EXPECT_EQ(part.surface.sides[0], (std::array<Index, 2>{4, 9}));
  EXPECT_EQ(part.surface.triangles[0], (Triangle{0, 2, 1})) << "the labels are in another order";
  EXPECT_EQ(part.surface.sides[1], (std::array<Index, 2>{4, kNoIndex}));
  EXPECT_EQ(part.surface.triangles[1], (Triangle{3, 4, 5}));
  const std::int64_t first = (std::int64_t{1} << 29) * 12;
  EXPECT_EQ(part.sites[0], (WholeSite{first + 1, first + 2, kNoIndex, kNoIndex}));
}

TEST(GridField, SlicesNeedThoseBesideThem) {
  GridMemberships grid = random_grid({4, 3, 5}, 2, 1);
  EXPECT_NO_THROW(require_slices(grid, {0, 5}, 1, 2));
  grid.below = 3;
  grid.above = 1;
  EXPECT_NO_THROW(require_slices(grid, {1, 3}, 1, 2));
  EXPECT_REFUSED(require_slices(grid, {0, 4}, 1, 2), testing::HasSubstr("beside"));
  EXPECT_REFUSED(require_slices(grid, {1, 4}, 1, 2), testing::HasSubstr("beside"));
  EXPECT_REFUSED(require_slices(grid, {3, 2}, 0, 0), testing::HasSubstr("slices of the grid"));
}

}  // namespace
}  // namespace mesamis
