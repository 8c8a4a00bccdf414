// SPDX-License-Identifier: Apache-2.0
#include "mesamis/label_files/voxel_lattice.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "support/expect_near.h"
#include "support/throws.h"

namespace mesamis {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

/// Turned about z by 30 degrees.
VoxelGrid whole_grid() {
  VoxelGrid grid;
  grid.size = {6, 5, 4};
  grid.spacing = {0.5, 0.7, 2};
  grid.origin = {10, -20, 30};
  const double c = std::cos(std::atan(1) * 2 / 3), s = std::sin(std::atan(1) * 2 / 3);
  grid.direction = {{Vec3{c, -s, 0}, Vec3{s, c, 0}, Vec3{0, 0, 1}}};
  return grid;
}

/// Voxels (1, 2, 1) to (4, 4, 3) of it, the axes i and k mirrored and exchanged.
VoxelGrid cut_and_turned() {
  const VoxelGrid whole = whole_grid();
  const Mat3 axes = transpose(whole.direction);
  VoxelGrid grid;
  grid.size = {3, 3, 4};
  grid.spacing = {2, 0.7, 0.5};
  grid.origin = whole.to_world({4 * 0.5, 2 * 0.7, 3 * 2.0});
  grid.direction = transpose(Mat3{{-1 * axes.rows[2], axes.rows[1], -1 * axes.rows[0]}});
  return grid;
}

TEST(VoxelLattice, FindsEachVoxelOfACutAndTurnedGrid) {
  const VoxelGrid whole = whole_grid(), part = cut_and_turned();
  const auto place = find_place(part, whole);
  ASSERT_TRUE(place);
  EXPECT_THAT(place->at({0, 0, 0}), ElementsAre(4, 2, 3));
  EXPECT_THAT(place->at({2, 2, 3}), ElementsAre(1, 4, 1));
  for (std::size_t n = 0; n < part.voxel_count(); ++n) {
    const auto v = part.voxel(n);
    const auto to = place->at(v);
    const auto mm = [](const VoxelGrid& grid, const auto& voxel) {
      return grid.to_world({static_cast<double>(voxel[0]) * grid.spacing.x,
                            static_cast<double>(voxel[1]) * grid.spacing.y,
                            static_cast<double>(voxel[2]) * grid.spacing.z});
    };
    EXPECT_LT(norm(mm(part, v) - mm(whole, to)), 1e-9);
  }
}

TEST(VoxelLattice, HasNoPlaceForVoxelsBetweenItsOwn) {
  const VoxelGrid whole = whole_grid();
  VoxelGrid part = whole;
  part.origin.x += 4e-4;
  EXPECT_TRUE(find_place(part, whole));
  part.origin.x += 0.2;
  EXPECT_FALSE(find_place(part, whole)) << "shifted";
  part = whole;
  part.spacing.z = 1;
  EXPECT_FALSE(find_place(part, whole)) << "finer";
  part.spacing.z = 2.001;
  EXPECT_FALSE(find_place(part, whole)) << "0.0015 voxels away at the far end";
  part = whole;
  part.direction = {};
  part.direction.rows = {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};
  EXPECT_FALSE(find_place(part, whole)) << "turned";
  part = whole;
  part.origin.x = 1e300;
  EXPECT_FALSE(find_place(part, whole)) << "beyond counting";
}

TEST(VoxelLattice, EnclosesAllGridsAlongTheAxesOfTheFirst) {
  const VoxelGrid whole = whole_grid(), part = cut_and_turned();
  VoxelGrid below = whole;
  below.origin = whole.to_world({-2 * 0.5, 0, -2});
  const std::vector<std::filesystem::path> files{"a", "b", "c"};
  const VoxelGrid all = enclosing_grid(files, std::vector{whole, part, below});
  EXPECT_THAT(all.size, ElementsAre(8, 5, 5));
  expect_near(all.origin, below.origin);
  EXPECT_EQ(all.spacing, whole.spacing);
  // Seen from the part: four voxels along i of the whole are four along its own k.
  EXPECT_THAT(enclosing_grid(files, std::vector{part, part}).size, ElementsAre(3, 3, 4));
}

TEST(VoxelLattice, RefusesGridsThatDoNotFitAndThoseFarApart) {
  const VoxelGrid whole = whole_grid();
  VoxelGrid other = whole;
  other.origin.z += 1;
  const std::vector<std::filesystem::path> files{"a.nii", "b.nii"};
  EXPECT_REFUSED(enclosing_grid(files, std::vector{whole, other}),
                 AllOf(HasSubstr("b.nii: expected the grid of a.nii"), HasSubstr("away")));
  other = whole;
  other.origin = whole.to_world({1e6, 7e5, 2e6});
  EXPECT_REFUSED(enclosing_grid(files, std::vector{whole, other}),
                 HasSubstr("more than 2^40 voxels"));
}

}  // namespace
}  // namespace mesamis
