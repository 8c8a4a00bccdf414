// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "mesamis/slabs/mapped_items.h"
#include "mesamis/slabs/mesh_files.h"
#include "mesamis/slabs/tasks.h"
#include "slabs/small_run.h"

namespace mesamis {
namespace {

void prepare_all(const SlabRun& run) {
  make_item_file<float>(run.scratch.path(kImageFile), run.plan.whole.voxel_count());
  for (Index s = 0; s < run.plan.count(); ++s) prepare_and_minimise(run, s);
}

TEST(PrepareAndMinimise, TheSlabsHaveTheSplineOfTheWhole) {
  const SmallRun small(72, {0, 33, 72});
  prepare_all(small.run);
  const Prepared whole = prepare_image(small.scan, quick_settings());
  const auto slabs = map_items<float>(small.scratch.path(kImageFile), small.scan.voxel_count());
  float largest = 0;
  for (std::size_t n = 0; n < slabs.values.size(); ++n) {
    largest = std::max(largest, std::abs(slabs.values[n] - whole.image.coefficients[n]));
  }
  EXPECT_LT(largest, 0.02) << "grey values, of 255";
}

TEST(PrepareAndMinimise, TheSlabsSurfacesAreThatOfTheWhole) {
  const SmallRun small(72, {0, 33, 72});
  prepare_all(small.run);
  const std::vector<GridSlab> slabs = grid_slabs(small.run);
  ASSERT_EQ(slabs.size(), 2U);
  const Prepared whole = prepare_image(small.scan, quick_settings());
  const double cells = cells_of(whole);
  EXPECT_NEAR((slabs[0].extent.cells + slabs[1].extent.cells) / cells, 1, 0.03)
      << "but for the slice that they have in common";
  EXPECT_GT(slabs[0].extent.cells, 0.3 * cells);
  EXPECT_LT(slabs[0].extent.low, slabs[0].extent.high);
}

TEST(PrepareAndMinimise, TellsWhereCellsWillBe) {
  const SmallRun small(72, {0, 33, 72});
  prepare_all(small.run);
  const std::vector<GridSlab> slabs = grid_slabs(small.run);
  ASSERT_EQ(slabs[0].complexities.size(), 33U);
  ASSERT_EQ(slabs[1].complexities.size(), 39U);
  const double full = slabs[0].complexities[25], empty = slabs[0].complexities[0];
  EXPECT_GT(full, 4 * empty) << "the rod begins in slice 5";
  EXPECT_NEAR(slabs[1].complexities[5] / full, 1, 0.35) << "and is as thick in both slabs";
  // The first of two meshes has 0.6 of the cells that the surface asks for.
  double sum = 0;
  for (const double complexity : slabs[0].complexities) sum += complexity;
  EXPECT_NEAR(sum * kCellsPerComplexity / (0.6 * slabs[0].extent.cells), 1, 0.2);
  EXPECT_GT(slabs[0].record.estimator, 0);
  EXPECT_GT(slabs[0].record.energy.total(), 0);
}

TEST(PrepareAndMinimise, TellsWhatItHasDone) {
  const SmallRun small(72, {0, 33, 72});
  make_item_file<float>(small.scratch.path(kImageFile), small.scan.voxel_count());
  const SlabWork work = prepare_and_minimise(small.run, 0);
  EXPECT_EQ(work.voxels, 32 * 30 * (33 + 16));
  EXPECT_EQ(work.rows, 32 * 30 * (33 + 8));
  EXPECT_EQ(work.bytes, 32 * 30 * 16 * 4);
  EXPECT_EQ(work.cells, 0);
}

TEST(PrepareAndMinimise, DoneAgainItLeavesTheSameFiles) {
  const SmallRun small(72, {0, 33, 72});
  prepare_all(small.run);
  const std::string image = read_bytes(small.scratch.path(kImageFile));
  prepare_and_minimise(small.run, 1);
  EXPECT_EQ(read_bytes(small.scratch.path(kImageFile)), image);
}

TEST(GridSlab, OnlyInnerBordersHaveNeighbours) {
  const SmallRun small(72, {0, 33, 72});
  const SlabPlan& plan = small.run.plan;
  EXPECT_FALSE(has_neighbour(plan, 0, Side::kLow));
  EXPECT_TRUE(has_neighbour(plan, 0, Side::kHigh));
  EXPECT_TRUE(has_neighbour(plan, 1, Side::kLow));
  EXPECT_FALSE(has_neighbour(plan, 1, Side::kHigh));
}

}  // namespace
}  // namespace mesamis
