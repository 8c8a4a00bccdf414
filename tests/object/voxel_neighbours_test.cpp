// SPDX-License-Identifier: Apache-2.0
#include "mesamis/object/voxel_neighbours.h"

#include <gtest/gtest.h>

#include <cstdlib>

#include "object/object_scenes.h"

namespace mesamis {
namespace {

TEST(VoxelNeighbours, AreThoseOneStepAwayInAscendingOrder) {
  const VoxelGrid grid = grid_of({4, 3, 5});
  for_each_voxel(grid, [&](const std::array<Index, 3>& v, std::size_t n) {
    std::vector<std::size_t> expected, found;
    for_each_voxel(grid, [&](const std::array<Index, 3>& w, std::size_t m) {
      if (std::abs(v[0] - w[0]) + std::abs(v[1] - w[1]) + std::abs(v[2] - w[2]) == 1) {
        expected.push_back(m);
      }
    });
    for_each_neighbour(grid, n, [&](std::size_t next, int axis) {
      found.push_back(next);
      const std::array<std::size_t, 3> step{1, 4, 12};
      EXPECT_EQ(std::max(n, next) - std::min(n, next), step[static_cast<std::size_t>(axis)]);
    });
    EXPECT_EQ(found, expected);
  });
}

TEST(VoxelNeighbours, TheBorderIsTheOutermostLayer) {
  const VoxelGrid grid = grid_of({4, 3, 5});
  std::size_t inner = 0;
  for (std::size_t n = 0; n < grid.voxel_count(); ++n) inner += !is_at_border(grid, n);
  EXPECT_EQ(inner, 2u * 1 * 3);
}

TEST(VoxelNeighbours, TheBorderOfASliceIsInItsPlane) {
  const VoxelGrid slice = grid_of({4, 5, 1});
  std::size_t inner = 0;
  for (std::size_t n = 0; n < slice.voxel_count(); ++n) inner += !is_at_border(slice, n);
  EXPECT_EQ(inner, 2u * 3);
}

}  // namespace
}  // namespace mesamis
