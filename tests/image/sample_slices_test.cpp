// SPDX-License-Identifier: Apache-2.0
#include "mesamis/image/sample_slices.h"

#include <gtest/gtest.h>

#include "support/sampled_volume.h"

namespace mesamis {
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

TEST(SampleSlices, OfAScanAreThoseOfItsSums) {
  const Volume scan =
      sampled_volume({4, 4, 10}, {1, 1, 1}, [](const Vec3& p) { return p.z == 6 ? p.x + p.y : 0; });
  const SliceRange some = sample_slices(scan, 3 * 16);
  const SliceRange same = sample_slices(scan, sums_of_slices(scan), 3 * 16);
  EXPECT_EQ(some.first, same.first);
  EXPECT_EQ(some.count, same.count);
  EXPECT_EQ(sample_slices(scan, 160).first, 0);
  EXPECT_EQ(sample_slices(scan, 160).count, 10);
}

TEST(SampleSlices, AreTwoAtLeast) {
  const std::vector<SliceSums> sums(10, {1, 1});
  EXPECT_EQ(sample_slices(grid_of({4, 4, 10}), sums, 1).count, 2);
}

}  // namespace
}  // namespace mesamis
