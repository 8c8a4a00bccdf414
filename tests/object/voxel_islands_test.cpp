// SPDX-License-Identifier: Apache-2.0
#include "mesamis/object/voxel_islands.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "object/object_scenes.h"
#include "support/throws.h"

namespace mesamis {
namespace {

using testing::Each;
using testing::ElementsAre;
using testing::HasSubstr;

/// Two slices of 4 x 3: a bar of three in the first, a pair across the slices, and one voxel that
/// touches the pair along an edge alone.
const VoxelGrid kGrid = grid_of({4, 3, 2});
const VoxelMask kMask{1, 1, 1, 0,  //
                      0, 0, 0, 0,  //
                      0, 9, 0, 0,  //

                      0, 0, 0, 0,  //
                      0, 0, 1, 0,  //
                      0, 1, 0, 0};

TEST(VoxelIslands, AreConnectedThroughFaces) {
  const VoxelIslands islands = find_islands(kMask, kGrid);
  EXPECT_THAT(islands.voxels, ElementsAre(3u, 2u, 1u));
  EXPECT_THAT(islands.of_voxel, ElementsAre(1, 1, 1, 0, 0, 0, 0, 0, 0, 2, 0, 0,  //
                                            0, 0, 0, 0, 0, 0, 3, 0, 0, 2, 0, 0));
  EXPECT_EQ(islands.largest(), 1);
}

TEST(VoxelIslands, OfACheckerboardAreItsVoxels) {
  const VoxelGrid grid = grid_of({5, 4, 3});
  VoxelMask mask(grid.voxel_count());
  for_each_voxel(grid, [&](const std::array<Index, 3>& v, std::size_t n) {
    mask[n] = (v[0] + v[1] + v[2]) % 2 == 0;
  });
  const VoxelIslands islands = find_islands(mask, grid);
  EXPECT_EQ(islands.voxels.size(), 30u);
  EXPECT_THAT(islands.voxels, Each(1u));
}

TEST(VoxelIslands, OfNothingAreNone) {
  const VoxelIslands islands = find_islands(VoxelMask(24, 0), kGrid);
  EXPECT_TRUE(islands.voxels.empty());
  EXPECT_EQ(islands.largest(), 0);
  EXPECT_REFUSED(find_islands(VoxelMask(25), kGrid), HasSubstr("found 25"));
}

TEST(VoxelIslands, OfEqualSizeTheFirstIsTheLargest) {
  const VoxelIslands islands{{1, 0, 2, 2, 0, 3, 3}, {1, 2, 2}};
  EXPECT_EQ(islands.largest(), 2);
}

TEST(VoxelIslands, RangesHoldEachIslandTightly) {
  const auto ranges = ranges_of(find_islands(kMask, kGrid), kGrid);
  EXPECT_THAT(ranges, ElementsAre(CropRange{{0, 0, 0}, {3, 1, 1}}, CropRange{{1, 2, 0}, {2, 3, 2}},
                                  CropRange{{2, 1, 1}, {3, 2, 2}}));
}

TEST(VoxelIslands, TheMasksOfAllMakeUpTheMask) {
  const VoxelGrid grid = grid_of({11, 9, 8});
  const VoxelMask mask = random_mask(grid, 0.3);
  const VoxelIslands islands = find_islands(mask, grid);
  VoxelMask all(mask.size(), 0);
  for (std::size_t island = 0; island < islands.voxels.size(); ++island) {
    const VoxelMask one = mask_of_island(islands, static_cast<Index>(island + 1));
    EXPECT_EQ(count_marked(one), islands.voxels[island]);
    for (std::size_t n = 0; n < all.size(); ++n) all[n] += one[n];
  }
  EXPECT_EQ(all, mask);
}

TEST(FindMarked, IsThatOfBruteForce) {
  const VoxelGrid grid = grid_of({9, 8, 7}, {0.7, 1.3, 2.9});
  const VoxelMask mask = random_mask(grid, 0.03, 5);
  constexpr double kMost = 3;
  std::size_t refused = 0;
  for_each_voxel(grid, [&](const std::array<Index, 3>& v, std::size_t) {
    std::size_t expected = mask.size();
    double least = kMost;
    for_each_voxel(grid, [&](const std::array<Index, 3>& w, std::size_t m) {
      const double mm = norm(Vec3{(v[0] - w[0]) * 0.7, (v[1] - w[1]) * 1.3, (v[2] - w[2]) * 2.9});
      if (mask[m] == 0 || mm > least || (mm == least && expected < mask.size())) return;
      least = mm;
      expected = m;
    });
    if (expected < mask.size()) {
      EXPECT_EQ(find_marked(mask, grid, v, kMost), expected);
      EXPECT_EQ(find_marked_at(mask, grid, v), std::vector{expected});
    } else {
      ++refused;
      EXPECT_FALSE(find_marked(mask, grid, v, kMost));
    }
  });
  EXPECT_GT(refused, 0u);
}

TEST(IslandAt, IsTheIslandNearestToThePlace) {
  const VoxelIslands islands = find_islands(kMask, kGrid);
  EXPECT_EQ(island_at(kMask, kGrid, {1, 0, 0}), mask_of_island(islands, 1));
  EXPECT_EQ(island_at(kMask, kGrid, {0, 2, 0}), mask_of_island(islands, 2));
  EXPECT_EQ(island_at(kMask, kGrid, {3, 1, 1}), mask_of_island(islands, 3));
}

TEST(IslandAt, FarFromAllIsRefused) {
  const VoxelGrid grid = grid_of({20, 2, 2});
  VoxelMask mask(grid.voxel_count(), 0);
  mask[0] = 1;
  EXPECT_EQ(island_at(mask, grid, {3, 0, 0}), mask);
  EXPECT_REFUSED(island_at(mask, grid, {4, 0, 0}), HasSubstr("nothing of it within 3 mm"));
}

/// A shell of one voxel around a cavity, 5 x 5 x 5 in 9 x 9 x 9.
VoxelMask shell(const VoxelGrid& grid) {
  return mask_where(grid, [](const Vec3& p) {
    const double away = std::max({std::abs(p.x - 4), std::abs(p.y - 4), std::abs(p.z - 4)});
    return away == 2;
  });
}

/// Around a place with nothing within 3 mm: a cavity that opens to one side, as that of spongy bone.
TEST(FindMarkedAt, IsWhatEnclosesThePlace) {
  const VoxelGrid grid = grid_of({31, 31, 31});
  const Vec3 middle{15, 15, 15};
  const VoxelMask open_shell = mask_where(grid, [&](const Vec3& p) {
    const double away = norm(p - middle);
    return away >= 8 && away < 10 && p.x < 21;
  });
  const std::vector<std::size_t> around = find_marked_at(open_shell, grid, {15, 15, 15});
  EXPECT_GE(around.size(), 17u);
  EXPECT_EQ(around[0], grid.offset(15, 15, 7));  // the first of those at 8 mm
  for (const std::size_t n : around) EXPECT_NE(open_shell[n], 0);
  EXPECT_TRUE(find_marked_at(open_shell, grid, {27, 15, 15}).empty()) << "outside";
  EXPECT_EQ(marked_at(open_shell, grid, {15, 15, 15}), around);
  EXPECT_REFUSED(marked_at(open_shell, grid, {27, 15, 15}), HasSubstr("within 3 mm or around it"));
}

/// Grains of spongy bone are not what a seed in it means.
TEST(FindMarkedAt, IsWhatEnclosesACrumb) {
  const VoxelGrid grid = grid_of({31, 31, 31});
  const auto with_grain = [&grid](double radius) {
    return mask_where(grid, [&](const Vec3& p) {
      const double away = norm(p - Vec3{15, 15, 15});
      const bool other_grain = norm(p - Vec3{15, 15, 20}) < 1.5;
      return away < radius || other_grain || (away >= 8 && away < 10 && p.x < 21);
    });
  };
  const VoxelMask grains = with_grain(2);
  const std::vector<std::size_t> around = find_marked_at(grains, grid, {15, 15, 15});
  EXPECT_GE(around.size(), 16u);
  EXPECT_GT(count_marked(island_at(grains, grid, {15, 15, 15})), 500u) << "the shell";
  EXPECT_EQ(find_marked_at(with_grain(6), grid, {15, 15, 15}).size(), 1u) << "no crumb";
  EXPECT_EQ(find_marked_at(with_grain(2), grid, {15, 15, 6}).size(), 1u) << "in the shell";
}

/// What lies far beyond an opening is not around the place.
TEST(FindMarkedAt, LeavesOutWhatIsFarThroughAnOpening) {
  const VoxelGrid grid = grid_of({61, 31, 31});
  const VoxelMask mask = mask_where(grid, [&](const Vec3& p) {
    const double away = norm(p - Vec3{15, 15, 15});
    return (away >= 8 && away < 10 && p.x < 22) || p.x > 40;
  });
  for (const std::size_t n : find_marked_at(mask, grid, {15, 15, 15})) {
    EXPECT_LT(grid.voxel(n)[0], 40);
  }
}

TEST(WithoutCavities, FillsWhatIsEnclosed) {
  const VoxelGrid grid = grid_of({9, 9, 9});
  const VoxelMask mask = shell(grid), filled = without_cavities(mask, grid);
  EXPECT_EQ(count_marked(filled), 125u);
  EXPECT_EQ(count_missing(mask, filled), 0u);
  EXPECT_EQ(without_cavities(filled, grid), filled);
}

TEST(WithoutCavities, LeavesWhatOpensToTheOutside) {
  const VoxelGrid grid = grid_of({9, 9, 9});
  VoxelMask mask = shell(grid);
  mask[grid.offset(4, 4, 2)] = 0;
  EXPECT_EQ(without_cavities(mask, grid), mask);
  EXPECT_EQ(without_cavities(VoxelMask(729, 0), grid), VoxelMask(729, 0));
  EXPECT_REFUSED(without_cavities(VoxelMask(728), grid), HasSubstr("found 728"));
}

TEST(WithoutCavities, InSlicesFillsWhatASliceEncloses) {
  const VoxelGrid grid = grid_of({9, 9, 9});
  const std::array<std::array<Index, 3>, 3> hole{{{2, 4, 4}, {4, 2, 4}, {4, 4, 2}}};
  for (int axis = 0; axis < 3; ++axis) {
    const auto& h = hole[static_cast<std::size_t>(axis)];
    VoxelMask mask = shell(grid);
    mask[grid.offset(h[0], h[1], h[2])] = 0;
    for (int across = 0; across < 3; ++across) {
      const VoxelMask filled = without_cavities_in_slices(mask, grid, across);
      // A hole in a face is seen from the side as a way out of the middle slice: its nine voxels
      // and the hole stay empty. From the front the other slices are closed, and so is the face.
      EXPECT_EQ(count_marked(filled), across == axis ? 125u : 125u - 10) << axis << across;
    }
  }
  EXPECT_REFUSED(without_cavities_in_slices(VoxelMask(728), grid, 0), HasSubstr("found 728"));
}

TEST(MaskAbove, MarksWhatExceedsTheLevel) {
  Volume volume;
  volume.size = {4, 1, 1};
  volume.samples = {-1, 2, 2.5F, 7};
  EXPECT_EQ(mask_above(volume, 2), (VoxelMask{0, 0, 1, 1}));
}

}  // namespace
}  // namespace mesamis
