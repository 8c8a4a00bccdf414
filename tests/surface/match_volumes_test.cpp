// SPDX-License-Identifier: Apache-2.0
#include "mesamis/surface/match_volumes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

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

/// Those of the nodes.
std::vector<double> wanted_of(const GridMemberships& grid) {
  return volumes_of(voxel_eighths(grid, grid.material), grid.spacing);
}

double volume_of(const GridMemberships& grid, Index label) {
  return check_surface(object_surface(extract_partition_on_grid(grid), label)).volume;
}

TEST(MatchVolumes, MovesAPlaneAmidTheVoxels) {
  // The first four layers of nodes are the first material: voxels up to 3.5 layers.
  for (const double height : {3.05, 3.3, 3.5, 3.95}) {
    GridMemberships grid = slabs(9, height);
    const SmoothReport report = match_volumes(grid, wanted_of(grid), {.volume_accuracy = 1e-6});
    EXPECT_TRUE(report.converged) << height;
    EXPECT_LE(report.volume_error, 1e-6);
    EXPECT_NEAR(volume_of(grid, 0), 12 * 3.5 * 0.5, 1e-4) << height;
    EXPECT_NEAR(volume_of(grid, 1), 12 * 4.5 * 0.5, 1e-4) << height;
  }
}

TEST(MatchVolumes, TellsTheWorstErrorWhereItDoesNothing) {
  GridMemberships grid = slabs(9, 3.1);
  const std::vector<float> before = grid.value;
  const SmoothReport report = match_volumes(grid, wanted_of(grid), {.most_rounds = 0});
  EXPECT_EQ(report.rounds, 0);
  EXPECT_FALSE(report.converged);
  EXPECT_NEAR(report.volume_error, 0.4 / 3.5, 1e-3);
  EXPECT_EQ(grid.value, before);
}

TEST(MatchVolumes, KeepsEachNodesMaterialAhead) {
  GridMemberships grid = slabs(9, 3.001);
  match_volumes(grid, wanted_of(grid), {});
  for (std::size_t n = 0; n < grid.material.size(); ++n) {
    const float lead = grid.value[2 * n] - grid.value[2 * n + 1];
    EXPECT_GE(grid.material[n] == 0 ? lead : -lead, 0.999F * kLeastLead);
  }
}

/// Some slices of a grid, from one to the one before the other.
GridMemberships slices_of(const GridMemberships& whole, Index begin, Index end) {
  GridMemberships some = whole;
  const auto layer = static_cast<std::ptrdiff_t>(whole.size[0]) * whole.size[1];
  const std::ptrdiff_t from = begin * layer, to = end * layer;
  some.size[2] = end - begin;
  some.below = begin;
  some.above = whole.size[2] - end;
  some.material.assign(whole.material.begin() + from, whole.material.begin() + to);
  some.first.assign(whole.first.begin() + from, whole.first.begin() + to + 1);
  const std::int64_t first = some.first.front();
  some.listed.assign(whole.listed.begin() + first, whole.listed.begin() + some.first.back());
  some.value.assign(whole.value.begin() + first, whole.value.begin() + some.first.back());
  for (std::int64_t& f : some.first) f -= first;
  return some;
}

TEST(MatchVolumes, SlicesAddUpToTheWholeGrid) {
  const GridMemberships whole = slabs(9, 3.3);
  const std::vector<LayerVolumes> layers = measure_layers(whole);
  const std::vector<std::int64_t> eighths = voxel_eighths(whole, whole.material);
  ASSERT_EQ(layers.size(), 8u);
  std::vector<std::int64_t> sum(2, 0);
  for (const auto& [begin, end] : {std::pair<Index, Index>{0, 4}, {4, 6}, {6, 9}}) {
    const GridMemberships own = slices_of(whole, begin, end);
    const std::vector<std::int64_t> some = voxel_eighths(own, own.material);
    for (std::size_t m = 0; m < 2; ++m) sum[m] += some[m];
    const auto found = measure_layers(slices_of(whole, begin, std::min<Index>(end + 1, 9)));
    for (std::size_t k = 0; k < found.size(); ++k) {
      const LayerVolumes& expected = layers[static_cast<std::size_t>(begin) + k];
      ASSERT_EQ(found[k].size(), expected.size());
      for (std::size_t n = 0; n < expected.size(); ++n) {
        EXPECT_EQ(found[k][n].sides, expected[n].sides);
        EXPECT_EQ(found[k][n].flux, expected[n].flux);
        EXPECT_EQ(found[k][n].slope, expected[n].slope);
      }
    }
  }
  EXPECT_EQ(sum, eighths);
}

}  // namespace
}  // namespace mesamis
