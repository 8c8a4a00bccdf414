// SPDX-License-Identifier: Apache-2.0
#include "mesamis/slabs/sample.h"

#include <gtest/gtest.h>

#include <numeric>

#include "support/sampled_volume.h"

namespace mesamis::detail {
namespace {

VoxelGrid grid_of(const std::array<Index, 3>& size) {
  VoxelGrid grid;
  grid.size = size;
  return grid;
}

TEST(SumsOfSlices, AreThoseOfTheirSamples) {
  const Volume volume =
      sampled_volume({3, 2, 4}, {1, 1, 1}, [](const Vec3& p) { return p.x + 10 * p.z; });
  const std::vector<SliceSums> sums = sums_of_slices(volume);
  ASSERT_EQ(sums.size(), 4U);
  EXPECT_EQ(sums[0].sum, 2 * (0 + 1 + 2));
  EXPECT_EQ(sums[0].squares, 2 * (0 + 1 + 4));
  EXPECT_EQ(sums[3].sum, 2 * (30 + 31 + 32));
}

TEST(SampleSlices, AreAllWhereTheyMayBe) {
  const std::vector<SliceSums> sums(10, {1, 1});
  const SliceRange all = sample_slices(grid_of({4, 4, 10}), sums, 160);
  EXPECT_EQ(all.first, 0);
  EXPECT_EQ(all.count, 10);
  EXPECT_EQ(sample_slices(grid_of({4, 4, 10}), sums, std::size_t{1} << 40).count, 10);
}

TEST(SampleSlices, AreThoseThatVaryMost) {
  std::vector<SliceSums> sums(10, {0, 0});
  sums[6] = {16, 16 * 100};  // the samples of one slice differ
  const SliceRange some = sample_slices(grid_of({4, 4, 10}), sums, 3 * 16);
  EXPECT_EQ(some.count, 3);
  EXPECT_LE(some.first, 6);
  EXPECT_GT(some.first + some.count, 6);
}

TEST(SampleSlices, AreTwoAtLeast) {
  const std::vector<SliceSums> sums(10, {1, 1});
  EXPECT_EQ(sample_slices(grid_of({4, 4, 10}), sums, 1).count, 2);
}

TEST(WorkOfSlices, GrowsWithTheSurface) {
  Choice choice;
  choice.parameters.level = 0.5;
  const Volume flat = sampled_volume({8, 8, 4}, {1, 1, 1}, [](const Vec3&) { return 0; });
  for (const double work : work_of_slices(flat, choice)) EXPECT_EQ(work, 64);
  // A plane between the slices 1 and 2 is crossed by 64 edges.
  const Volume step =
      sampled_volume({8, 8, 4}, {1, 1, 1}, [](const Vec3& p) { return p.z > 1.5 ? 1 : 0; });
  const std::vector<double> work = work_of_slices(step, choice);
  ASSERT_EQ(work.size(), 3U);
  EXPECT_EQ(work[0], 64);
  EXPECT_GT(work[1], 10 * 64);
  EXPECT_EQ(work[2], 64);
}

TEST(WorkOfSlices, CountsCrossingsAlikeAlongAllAxes) {
  Choice choice;
  choice.parameters.level = 0.5;
  std::array<double, 3> work{};
  for (int axis = 0; axis < 3; ++axis) {
    const Volume step = sampled_volume({9, 9, 9}, {1, 1, 1},
                                       [axis](const Vec3& p) { return p[axis] > 3.5 ? 1 : 0; });
    const std::vector<double> slices = work_of_slices(step, choice);
    work[static_cast<std::size_t>(axis)] = std::accumulate(slices.begin(), slices.end(), 0.0);
  }
  EXPECT_EQ(work[0], work[1]);
  EXPECT_NEAR(work[0] - 8 * 81, (work[2] - 8 * 81) * 8 / 9, 1e-9) << "the last slice is left out";
}

}  // namespace
}  // namespace mesamis::detail
