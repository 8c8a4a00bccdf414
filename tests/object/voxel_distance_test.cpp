// SPDX-License-Identifier: Apache-2.0
#include "mesamis/object/voxel_distance.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "mesamis/base/parallel.h"
#include "object/object_scenes.h"
#include "support/throws.h"

namespace mesamis {
namespace {

using testing::Each;
using testing::HasSubstr;

/// The distance to the nearest marked voxel, by looking at all.
std::vector<float> by_brute_force(const VoxelMask& mask, const VoxelGrid& grid) {
  std::vector<float> distance(mask.size(), std::numeric_limits<float>::infinity());
  const Vec3& s = grid.spacing;
  for_each_voxel(grid, [&](const std::array<Index, 3>& v, std::size_t n) {
    for_each_voxel(grid, [&](const std::array<Index, 3>& w, std::size_t m) {
      if (mask[m] == 0) return;
      const double mm = norm(Vec3{(v[0] - w[0]) * s.x, (v[1] - w[1]) * s.y, (v[2] - w[2]) * s.z});
      distance[n] = std::min(distance[n], static_cast<float>(mm));
    });
  });
  return distance;
}

TEST(VoxelDistance, IsThatOfBruteForce) {
  for (const auto& spacing : {Vec3{1, 1, 1}, Vec3{0.7, 1.3, 2.9}, Vec3{5, 0.01, 0.3}}) {
    for (const double probability : {0.004, 0.05, 0.5, 0.98}) {
      const VoxelGrid grid = grid_of({13, 9, 7}, spacing);
      const VoxelMask mask = random_mask(grid, probability, 7);
      if (count_marked(mask) == 0) continue;
      const auto found = distance_to_mask(mask, grid), expected = by_brute_force(mask, grid);
      for (std::size_t n = 0; n < mask.size(); ++n) {
        ASSERT_NEAR(found[n], expected[n], 1e-6 * (1 + expected[n])) << n;
      }
    }
  }
}

TEST(VoxelDistance, IsInfiniteFromAnEmptyMaskAndZeroInAFullOne) {
  const VoxelGrid grid = grid_of({4, 3, 2});
  EXPECT_THAT(distance_to_mask(VoxelMask(24, 0), grid),
              Each(std::numeric_limits<float>::infinity()));
  EXPECT_THAT(distance_to_mask(VoxelMask(24, 255), grid), Each(0.F));
}

TEST(VoxelDistance, HasTheSameBitsForAnyNumberOfThreads) {
  const VoxelGrid grid = grid_of({70, 65, 40}, {0.7, 1.3, 2.9});
  const VoxelMask mask = random_mask(grid, 0.001);
  const auto one = with_threads(1, [&] { return distance_to_mask(mask, grid); });
  EXPECT_EQ(with_threads(2, [&] { return distance_to_mask(mask, grid); }), one);
}

TEST(VoxelDistance, OfAMaskOfAnotherGridIsRefused) {
  const VoxelGrid grid = grid_of({4, 3, 2});
  const VoxelMask mask(23);
  EXPECT_REFUSED(require_mask_of(mask, grid), HasSubstr("24 voxels, found 23"));
  EXPECT_REFUSED(distance_to_mask(mask, grid), HasSubstr("24 voxels, found 23"));
  EXPECT_REFUSED(dilated(mask, grid, 1), HasSubstr("24 voxels, found 23"));
  EXPECT_NO_THROW(require_mask_of(VoxelMask(24), grid));
}

TEST(Dilated, MarksAllWithinTheDistance) {
  const VoxelGrid grid = grid_of({13, 9, 7}, {0.7, 1.3, 2.9});
  const VoxelMask mask = random_mask(grid, 0.02);
  const auto distance = by_brute_force(mask, grid);
  for (const double mm : {0.0, 0.6, 0.7, 1.3, 2.0, 3.5, 100.0}) {
    const VoxelMask grown = dilated(mask, grid, mm);
    for (std::size_t n = 0; n < mask.size(); ++n) {
      ASSERT_EQ(grown[n], distance[n] <= mm * (1 + 1e-6)) << mm << " mm, voxel " << n;
    }
  }
}

TEST(Dilated, ByNoDistanceChangesNothing) {
  const VoxelGrid grid = grid_of({13, 9, 7});
  const VoxelMask mask = random_mask(grid, 0.3);
  EXPECT_EQ(dilated(mask, grid, 0), mask);
}

TEST(Dilated, ByLessThanNothingIsRefused) {
  const VoxelGrid grid = grid_of({4, 3, 2});
  const VoxelMask mask(24);
  EXPECT_REFUSED(dilated(mask, grid, -1), HasSubstr("margin"));
  EXPECT_REFUSED(dilated(mask, grid, std::nan("")), HasSubstr("margin"));
}

TEST(Eroded, MarksWhatIsFartherThanTheDistanceFromWhatIsNotMarked) {
  const VoxelGrid grid = grid_of({13, 9, 7}, {0.7, 1.3, 2.9});
  const VoxelMask mask = random_mask(grid, 0.98);
  const auto distance = by_brute_force(complement(mask), grid);
  for (const double mm : {0.0, 0.7, 1.3, 2.0}) {
    const VoxelMask core = eroded(mask, grid, mm);
    for (std::size_t n = 0; n < mask.size(); ++n) {
      ASSERT_EQ(core[n], distance[n] > mm * (1 + 1e-6)) << mm << " mm, voxel " << n;
    }
  }
  EXPECT_EQ(eroded(VoxelMask(mask.size(), 1), grid, 5), VoxelMask(mask.size(), 1));
  EXPECT_REFUSED(eroded(mask, grid, -1), HasSubstr("margin"));
}

TEST(OnlyIn, KeepsWhatTheOtherLacks) {
  EXPECT_EQ(only_in(VoxelMask{0, 1, 255, 9}, VoxelMask{0, 0, 2, 0}), (VoxelMask{0, 1, 0, 1}));
}

TEST(Complement, SwapsInsideAndOutside) {
  EXPECT_EQ(complement(VoxelMask{0, 1, 255, 0}), (VoxelMask{1, 0, 0, 1}));
}

TEST(CountMarked, CountsWhatIsNotZero) {
  EXPECT_EQ(count_marked(VoxelMask{0, 1, 255, 0, 2}), 3u);
  EXPECT_EQ(count_marked(VoxelMask{}), 0u);
}

}  // namespace
}  // namespace mesamis
