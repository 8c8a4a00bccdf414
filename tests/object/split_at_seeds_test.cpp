// SPDX-License-Identifier: Apache-2.0
#include "mesamis/object/split_at_seeds.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "mesamis/base/parallel.h"
#include "mesamis/object/voxel_islands.h"
#include "object/object_scenes.h"
#include "support/throws.h"

namespace mesamis {
namespace {

using testing::HasSubstr;

using Seeds = std::vector<std::array<Index, 3>>;

/// Two balls of 8 mm about x = 10.5 and 29.5, joined by a neck of 4 mm along x.
const VoxelGrid kGrid = grid_of({41 - 1, 21, 21});
const VoxelMask kBalls = mask_where(kGrid, [](const Vec3& p) {
  const double from_axis = std::hypot(p.y - 10, p.z - 10);
  return norm(p - Vec3{10, 10, 10}) < 8 || norm(p - Vec3{29, 10, 10}) < 8 ||
         (from_axis < 4 && p.x > 10 && p.x < 29);
});

std::vector<std::uint16_t> split(const Volume& volume, const VoxelMask& mask, const Seeds& seeds) {
  const LabelMap map = split_at_seeds(volume, mask, 50, seeds);
  EXPECT_NO_THROW(require_valid(map));
  EXPECT_EQ(map.segments.size(), seeds.size());
  return map.layers[0];
}

/// Labels are in the mask, and on all of it.
void expect_all_labelled(const std::vector<std::uint16_t>& labels, const VoxelMask& mask) {
  for (std::size_t n = 0; n < mask.size(); ++n) ASSERT_EQ(labels[n] != 0, mask[n] != 0);
}

TEST(SplitAtSeeds, MeetsHalfWayInTheNeckOfEqualBalls) {
  const Volume volume = volume_of(kGrid, kBalls, 100, 0);
  const auto labels = split(volume, kBalls, {{10, 10, 10}, {29, 10, 10}});
  expect_all_labelled(labels, kBalls);
  for_each_voxel(kGrid, [&](const std::array<Index, 3>& v, std::size_t n) {
    if (kBalls[n] != 0) {
      EXPECT_EQ(labels[n], v[0] < 20 ? 1 : 2) << v[0] << ' ' << v[1];
    }
  });
}

TEST(SplitAtSeeds, GivesTheSamePartsWhereverTheSeedsAre) {
  const Volume volume = volume_of(kGrid, kBalls, 100, 0);
  const auto labels = split(volume, kBalls, {{4, 8, 10}, {31, 14, 7}});
  for_each_voxel(kGrid, [&](const std::array<Index, 3>& v, std::size_t n) {
    if (kBalls[n] == 0 || std::abs(v[0] - 19.5) < 4) return;  // the neck
    EXPECT_EQ(labels[n], v[0] < 20 ? 1 : 2);
  });
}

TEST(SplitAtSeeds, MeetsInADarkCleft) {
  const VoxelGrid grid = grid_of({40, 16, 16});
  const VoxelMask bar = mask_where(grid, [](const Vec3& p) {
    return p.x >= 2 && p.x < 38 && p.y >= 2 && p.y < 14 && p.z >= 2 && p.z < 14;
  });
  Volume volume = volume_of(grid, bar, 100, 0);
  for_each_voxel(grid, [&](const std::array<Index, 3>& v, std::size_t n) {
    if (v[0] == 27) volume.samples[n] *= 0.7F;
  });
  const auto labels = split(volume, bar, {{5, 8, 8}, {34, 8, 8}});
  expect_all_labelled(labels, bar);
  for_each_voxel(grid, [&](const std::array<Index, 3>& v, std::size_t n) {
    if (bar[n] != 0 && v[0] != 27) {
      EXPECT_EQ(labels[n], v[0] < 27 ? 1 : 2) << v[0];
    }
  });
}

/// A filled cavity is as deep as what is solid: a wall around it does not make a neck.
TEST(SplitAtSeeds, SplitsFilledCavitiesWithTheirWalls) {
  VoxelMask hollow = kBalls;
  for_each_voxel(kGrid, [&](const std::array<Index, 3>& v, std::size_t n) {
    const Vec3 p{double(v[0]), double(v[1]), double(v[2])};
    if (norm(p - Vec3{10, 10, 10}) < 6 || norm(p - Vec3{29, 10, 10}) < 6) hollow[n] = 0;
  });
  const Volume volume = volume_of(kGrid, hollow, 100, 0);
  const VoxelMask filled = without_cavities(hollow, kGrid);
  const auto labels = split(volume, filled, {{3, 10, 10}, {36, 10, 10}});
  expect_all_labelled(labels, filled);
  for_each_voxel(kGrid, [&](const std::array<Index, 3>& v, std::size_t n) {
    if (filled[n] == 0) return;
    EXPECT_EQ(labels[n], v[0] < 20 ? 1 : 2) << v[0] << ' ' << v[1];
  });
}

/// Spongy bone is darker than its shell, which has openings: a seed in it stands for the shell.
TEST(SplitAtSeeds, SplitsOpenShellsFromTheirMiddles) {
  VoxelMask open = kBalls;
  for_each_voxel(kGrid, [&](const std::array<Index, 3>& v, std::size_t n) {
    const Vec3 p{double(v[0]), double(v[1]), double(v[2])};
    const bool hollow = norm(p - Vec3{10, 10, 10}) < 6 || norm(p - Vec3{29, 10, 10}) < 6;
    const bool opening = std::hypot(p.x - 10, p.z - 10) < 2 && p.y > 10;
    if (hollow || opening) open[n] = 0;
  });
  ASSERT_EQ(without_cavities(open, kGrid)[kGrid.offset(10, 10, 10)], 0);
  const auto labels = split(volume_of(kGrid, open, 100, 0), open, {{10, 10, 10}, {29, 10, 10}});
  expect_all_labelled(labels, open);
  for_each_voxel(kGrid, [&](const std::array<Index, 3>& v, std::size_t n) {
    if (open[n] == 0 || std::abs(v[0] - 19.5) < 2) return;
    EXPECT_EQ(labels[n], v[0] < 20 ? 1 : 2) << v[0] << ' ' << v[1] << ' ' << v[2];
  });
}

TEST(SplitAtSeeds, LeavesIslandsWithoutASeed) {
  const VoxelGrid grid = grid_of({10, 4, 4});
  const VoxelMask mask = mask_where(grid, [](const Vec3& p) { return p.x < 4 || p.x > 5; });
  const auto labels = split(volume_of(grid, mask, 100, 0), mask, {{1, 1, 1}});
  for_each_voxel(grid, [&](const std::array<Index, 3>& v, std::size_t n) {
    EXPECT_EQ(labels[n], v[0] < 4 ? 1 : 0);
  });
}

TEST(SplitAtSeeds, ASeedMayBeBesideTheObjectAndTheNamesAreNumbered) {
  const VoxelGrid grid = grid_of({10, 4, 4});
  const VoxelMask mask = mask_where(grid, [](const Vec3& p) { return p.x < 3 || p.x > 7; });
  const LabelMap map =
      split_at_seeds(volume_of(grid, mask, 100, 0), mask, 50, Seeds{{9, 1, 1}, {4, 1, 1}});
  EXPECT_EQ(map.layers[0][grid.offset(9, 0, 0)], 1);
  EXPECT_EQ(map.layers[0][grid.offset(0, 0, 0)], 2);
  EXPECT_EQ(map.segments[1].name, "part 2");
  EXPECT_EQ(map.segments[1].label, 2);
}

TEST(SplitAtSeeds, RefusesSeedsThatFitNothing) {
  const VoxelGrid grid = grid_of({10, 4, 4});
  const VoxelMask mask = mask_where(grid, [](const Vec3& p) { return p.x < 3; });
  const Volume volume = volume_of(grid, mask, 100, 0);
  const auto at = [&](const Seeds& seeds) { return split_at_seeds(volume, mask, 50, seeds); };
  EXPECT_REFUSED(at({}), HasSubstr("expected 1 to 65535"));
  EXPECT_REFUSED(at(Seeds(65536, {0, 0, 0})), HasSubstr("expected 1 to 65535"));
  EXPECT_REFUSED(at({{0, 0, 4}}), HasSubstr("voxel of the scan"));
  EXPECT_REFUSED(at({{-1, 0, 0}}), HasSubstr("voxel of the scan"));
  EXPECT_REFUSED(at({{8, 0, 0}}), HasSubstr("nothing of it within 3 mm or around it"));
  EXPECT_REFUSED(at({{1, 1, 1}, {1, 1, 1}}), HasSubstr("same voxel"));
  EXPECT_REFUSED(split_at_seeds(volume, VoxelMask(3), 50, Seeds{{0, 0, 0}}), HasSubstr("mask"));
}

TEST(SplitAtSeeds, HasTheSameLabelsForAnyNumberOfThreads) {
  Volume volume = volume_of(kGrid, kBalls, 100, 0);
  add_noise(volume, 10);
  const auto labels = [&] { return split(volume, kBalls, {{8, 9, 10}, {30, 10, 10}}); };
  EXPECT_EQ(with_threads(2, labels), with_threads(1, labels));
}

}  // namespace
}  // namespace mesamis
