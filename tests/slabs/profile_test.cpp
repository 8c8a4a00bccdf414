// SPDX-License-Identifier: Apache-2.0
#include "mesamis/slabs/profile.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/perturbed_box.h"
#include "support/throws.h"

namespace mesamis {
namespace {

using testing::HasSubstr;

const SizeControl kNoBounds{1e-9, 1e9, 0};

SlabPlan plan_of(Index slices) {
  VoxelGrid grid;
  grid.size = {5, 5, slices};
  return plan_slabs(grid, std::vector<double>(static_cast<std::size_t>(slices), 1), {.slabs = 1});
}

/// Cells of size 1/2 from height 3 to 7.
Piece piece() {
  Piece piece{perturbed_box({{0, 0, 3}, {4, 4, 7}}, {4, 4, 4}, 0), {}};
  for (std::size_t n = 0; n < piece.mesh.points.size(); ++n) {
    piece.nodes.push_back({0, 0, 0, 4 * kIdentity3});
  }
  return piece;
}

TEST(Profile, HasTheComplexityOfEachSlice) {
  const Profile profile = profile_of(plan_of(20), piece(), kNoBounds);
  EXPECT_EQ(profile.first_slice, 3);
  ASSERT_EQ(profile.slices.size(), 5U) << "of nodes, none after the last";
  // Eight times the volume; the nodes at both ends stand for half of a layer.
  EXPECT_NEAR(sum_of(profile.slices)[0], 8 * 64, 1e-9);
  EXPECT_NEAR(profile.slices[2][0], 8 * 16, 1e-9);
  EXPECT_NEAR(profile.slices[0][0] + profile.slices[4][0], 8 * 16, 1e-9);
}

TEST(Profile, FallsWithTheCubeOfTheFactor) {
  const Complexities all = sum_of(profile_of(plan_of(20), piece(), kNoBounds).slices);
  for (const double factor : {1.0, 1.05, 1.7, 30.0}) {
    EXPECT_NEAR(complexity_at(all, factor), 512 / std::pow(factor, 3), 1e-6) << factor;
    EXPECT_NEAR(factor_for(all, 512 / std::pow(factor, 3)), factor, 1e-6 * factor);
  }
  EXPECT_EQ(factor_for(all, 1000), 1) << "never finer than asked";
  EXPECT_EQ(complexity_at({}, 2), 0);
}

TEST(Profile, OfSlabsAddUpToThatOfTheWhole) {
  const Profile one = profile_of(plan_of(20), piece(), kNoBounds);
  ArchiveWriter written;
  add_profile(written, one);
  add_profile(written, one);
  add_profile(written, profile_of(plan_of(20), {}, kNoBounds));
  ArchiveReader archive(std::string(written.bytes()), "file");
  std::vector<Complexities> sums(20);
  for (int slab = 0; slab < 3; ++slab) add_next_profile(archive, sums);
  EXPECT_NEAR(sums[5][10], 2 * one.slices[2][10], 1e-12);
  EXPECT_EQ(sums[2][0], 0);
  EXPECT_NEAR(sum_of(sums)[0], 2 * 512, 1e-9);
}

TEST(Profile, RefusesSlicesThatAreNotThere) {
  ArchiveWriter written;
  add_profile(written, profile_of(plan_of(20), piece(), kNoBounds));
  ArchiveReader archive(std::string(written.bytes()), "file");
  std::vector<Complexities> sums(7);
  EXPECT_REFUSED(add_next_profile(archive, sums), HasSubstr("found one to slice 8"));
}

}  // namespace
}  // namespace mesamis
