// SPDX-License-Identifier: Apache-2.0
#include "mesamis/slabs/plan.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>

#include "support/throws.h"

namespace mesamis {
namespace {

using testing::AllOf;
using testing::HasSubstr;

VoxelGrid grid_of(const std::array<Index, 3>& size, const Vec3& spacing = {1, 1, 1}) {
  VoxelGrid grid;
  grid.size = size;
  grid.spacing = spacing;
  return grid;
}

std::vector<double> even_work(Index slices) {
  return std::vector<double>(static_cast<std::size_t>(slices), 1.0);
}

double work_of(const SlabPlan& plan, const std::vector<double>& work, Index s) {
  const auto at = static_cast<std::size_t>(s);
  return std::accumulate(work.begin() + plan.cuts[at], work.begin() + plan.cuts[at + 1], 0.0);
}

TEST(SlabPlan, CutsCoverAllSlicesWithEqualWork) {
  std::mt19937 generator(3);
  std::uniform_real_distribution<double> uniform(0.5, 3);
  std::vector<double> work(400);
  for (double& w : work) w = uniform(generator);
  const double all = std::accumulate(work.begin(), work.end(), 0.0);
  for (const Index count : {1, 2, 3, 5, 8}) {
    const SlabPlan plan = plan_slabs(grid_of({30, 30, 400}), work, {.slabs = count});
    ASSERT_EQ(plan.count(), count);
    EXPECT_EQ(plan.cuts.front(), 0);
    EXPECT_EQ(plan.cuts.back(), 400);
    const double heaviest = *std::max_element(work.begin(), work.end());
    for (Index s = 0; s < count; ++s) {
      EXPECT_NEAR(work_of(plan, work, s), all / count, heaviest) << "within a slice";
    }
  }
}

TEST(SlabPlan, NoSlabIsThinnerThanFourOverlaps) {
  // All the work is in the last slices.
  std::vector<double> work(200, 0);
  work[198] = work[199] = 100;
  const SlabPlan plan = plan_slabs(grid_of({20, 20, 200}), work, {.slabs = 4});
  EXPECT_GE(plan.thinnest(), 4 * plan.overlap - 1) << "the last one ends at its last slice";
  EXPECT_EQ(plan.cuts, (std::vector<Index>{0, 100, 136, 168, 200}));
  EXPECT_NO_THROW(plan_slabs(grid_of({20, 20, 200}), std::vector<double>(200, 0), {.slabs = 4}));
}

TEST(SlabPlan, NoSlabIsThickerThanTwiceTheMean) {
  for (const Index busy : {0, 90, 199}) {  // the slice with all the work
    std::vector<double> work(200, 0);
    work[static_cast<std::size_t>(busy)] = 1;
    const SlabPlan plan = plan_slabs(grid_of({20, 20, 200}), work, {.slabs = 4});
    EXPECT_EQ(plan.cuts.front(), 0);
    EXPECT_EQ(plan.cuts.back(), 200);
    for (Index s = 0; s < 4; ++s) {
      const auto at = static_cast<std::size_t>(s);
      EXPECT_LE(plan.cuts[at + 1] - plan.cuts[at], 100) << busy;
      EXPECT_GE(plan.cuts[at + 1] - plan.cuts[at], 32) << busy;
    }
  }
}

TEST(SlabPlan, EqualSlicesMakeEqualSlabs) {
  EXPECT_EQ(plan_slabs(grid_of({20, 20, 200}), even_work(200), {.slabs = 5}).cuts,
            (std::vector<Index>{0, 40, 80, 120, 160, 200}));
  EXPECT_EQ(plan_slabs(grid_of({20, 20, 640}), even_work(640), {.slabs = 10}).cuts[9], 576);
}

TEST(SlabPlan, SlabsMayHaveMostSlicesWhereThatIsAsked) {
  std::vector<double> work(400, 0);
  for (std::size_t k = 240; k < 400; ++k) work[k] = 1;
  const SlabPlan plan = plan_slabs(grid_of({20, 20, 400}), work, {.slabs = 4, .bounded = false});
  EXPECT_EQ(plan.cuts, (std::vector<Index>{0, 280, 320, 360, 400}));
}

TEST(SlabPlan, WorkThatIsDoneAgainCountsForTheSlabBelow) {
  const SlabOptions options{.slabs = 3, .again = 10};
  const SlabPlan plan = plan_slabs(grid_of({20, 20, 400}), even_work(400), options);
  // Two borders of twenty slices: 440 in all.
  EXPECT_NEAR(plan.cuts[1], 440.0 / 3 - 20, 1);
  EXPECT_NEAR(plan.cuts[2] - plan.cuts[1], 440.0 / 3 - 20, 1);
  EXPECT_NEAR(400 - plan.cuts[2], 440.0 / 3, 2);
}

TEST(SlabPlan, RefusesSlabsThatWouldBeTooThin) {
  const auto plan = [](Index slices, Index count) {
    return plan_slabs(grid_of({20, 20, slices}), even_work(slices), {.slabs = count});
  };
  EXPECT_EQ(plan(96, 3).count(), 3);
  EXPECT_REFUSED(plan(95, 3), AllOf(HasSubstr("expected 1 to 2"), HasSubstr("found 3")));
  EXPECT_REFUSED(plan(400, 0), HasSubstr("found 0"));
  EXPECT_REFUSED(plan(400, -2), HasSubstr("found -2"));
  EXPECT_REFUSED(plan(400, 2'000'000'000), HasSubstr("expected 1 to 12"));
  EXPECT_EQ(plan(10, 1).count(), 1) << "one slab has no borders";
}

TEST(SlabPlan, SlabsAreTwiceAsThickAsTheyMustBeUnlessTold) {
  const auto count = [](const std::array<Index, 3>& size) {
    return plan_slabs(grid_of(size), even_work(size[2]), {}).count();
  };
  EXPECT_EQ(count({64, 64, 127}), 1);
  EXPECT_EQ(count({64, 64, 128}), 2);
  EXPECT_EQ(count({512, 512, 512}), 8);
  EXPECT_EQ(count({2048, 2048, 2048}), 32);
  const SlabPlan large = plan_slabs(grid_of({1024, 1024, 1024}), even_work(1024), {});
  EXPECT_EQ(large.count(), 16);
  EXPECT_EQ(large.cuts[1], 64);
  // Thinner ones where they are large; as many as are thick enough.
  EXPECT_EQ(count({4096, 4096, 4096}), 128);
  EXPECT_EQ(count({4096, 4096, 100}), 3);
}

TEST(SlabPlan, RoundingOfTheVoxelSizeAddsNoSlice) {
  for (int n = 1; n <= 1000; ++n) {
    for (const double side : {n / 1000.0, static_cast<double>(static_cast<float>(n / 1000.0))}) {
      const VoxelGrid grid = grid_of({64, 64, 512}, {side, side, side});
      ASSERT_EQ(plan_slabs(grid, even_work(512), {.unit_mm = grid.voxel_size()}).count(), 8)
          << side;
    }
  }
}

TEST(SlabPlan, LengthsAreInTheUnitOfTheMeshes) {
  const VoxelGrid grid = grid_of({41, 41, 101}, {0.5, 0.5, 2});
  SlabOptions options{.unit_mm = 0.5, .slabs = 1};
  const SlabPlan plan = plan_slabs(grid, even_work(101), options);
  EXPECT_EQ(plan.box().hi, (Vec3{40, 40, 400}));
  EXPECT_EQ(plan.height_of_slice(3), 12);
  EXPECT_EQ(plan.slice_at(12), 3U);
  EXPECT_EQ(plan.slice_at(15.9), 3U);
  EXPECT_EQ(plan.slice_at(-5), 0U);
  EXPECT_EQ(plan.slice_at(1e9), 100U);
  EXPECT_EQ(plan.least_thickness(), 4 * plan.overlap);
  EXPECT_EQ(plan.height(0), 0);
  EXPECT_EQ(plan.height(1), 400);
  EXPECT_EQ(plan.slices_in(4), 1);
  EXPECT_EQ(plan.slices_in(4.1), 2);
  EXPECT_EQ(plan.thinnest(), 400);
  EXPECT_NEAR(plan.overlap, 8 * grid.voxel_size() / 0.5, 1e-12);
  // Influences reach as far as the root of beta.
  options.beta = 8;
  EXPECT_NEAR(plan_slabs(grid, even_work(101), options).overlap, 2 * plan.overlap, 1e-12);
  options.beta = 0.1;
  EXPECT_EQ(plan_slabs(grid, even_work(101), options).overlap, plan.overlap);
}

TEST(SlabPlan, SlabsMeetAtTheSliceWhereTheNextOneBegins) {
  const SlabPlan plan = plan_slabs(grid_of({20, 20, 100}), even_work(100), {.slabs = 2});
  EXPECT_EQ(plan.height(1), plan.height_of_slice(plan.cuts[1]));
  EXPECT_EQ(plan.height(2), 99);
}

}  // namespace
}  // namespace mesamis
