// SPDX-License-Identifier: Apache-2.0
#include "mesamis/surface/match_volumes.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/partition_laws.h"

namespace mesamis {
namespace {

/// Two slabs: the membership of the first falls along k, and is 0 at a height in nodes.
GridMemberships slabs(Index layers, double height) {
  GridMemberships grid{.size = {4, 5, layers},
                       .spacing = {1, 1, 0.5},
                       .material = {},
                       .label = {0, 1},
                       .first = {0},
                       .listed = {},
                       .value = {}};
  for (Index n = 0; n < 20 * layers; ++n) {
    const double lead = 0.5 * (height - n / 20);
    grid.material.push_back(lead > 0 ? 0 : 1);
    grid.listed.insert(grid.listed.end(), {0, 1});
    grid.value.insert(grid.value.end(), {static_cast<float>(lead), 0});
    grid.first.push_back(static_cast<std::int64_t>(grid.value.size()));
  }
  return grid;
}

double volume_of(const GridMemberships& grid, Index label) {
  return check_surface(object_surface(extract_partition_on_grid(grid), label)).volume;
}

TEST(MatchVolumes, MovesAPlaneAmidTheVoxels) {
  // The first four layers of nodes are the first material: voxels up to 3.5 layers.
  for (const double height : {3.05, 3.3, 3.5, 3.95}) {
    GridMemberships grid = slabs(9, height);
    SmoothReport report;
    match_volumes(grid, part_volumes(grid, grid.material), {.volume_accuracy = 1e-6}, report);
    EXPECT_TRUE(report.converged) << height;
    EXPECT_LE(report.volume_error, 1e-6);
    EXPECT_NEAR(volume_of(grid, 0), 12 * 3.5 * 0.5, 1e-4) << height;
    EXPECT_NEAR(volume_of(grid, 1), 12 * 4.5 * 0.5, 1e-4) << height;
  }
}

TEST(MatchVolumes, TellsTheWorstErrorWhereItDoesNothing) {
  GridMemberships grid = slabs(9, 3.1);
  const std::vector<float> before = grid.value;
  SmoothReport report;
  match_volumes(grid, part_volumes(grid, grid.material), {.most_rounds = 0}, report);
  EXPECT_EQ(report.rounds, 0);
  EXPECT_FALSE(report.converged);
  EXPECT_NEAR(report.volume_error, 0.4 / 3.5, 1e-3);
  EXPECT_EQ(grid.value, before);
}

TEST(MatchVolumes, KeepsEachNodesMaterialAhead) {
  GridMemberships grid = slabs(9, 3.001);
  SmoothReport report;
  match_volumes(grid, part_volumes(grid, grid.material), {}, report);
  for (std::size_t n = 0; n < grid.material.size(); ++n) {
    const float lead = grid.value[2 * n] - grid.value[2 * n + 1];
    EXPECT_GE(grid.material[n] == 0 ? lead : -lead, 0.999F * kLeastLead);
  }
}

}  // namespace
}  // namespace mesamis
