// SPDX-License-Identifier: Apache-2.0
#include "mesamis/surface/grid_partition.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <limits>

#include "mesamis/base/parallel.h"
#include "support/partition_laws.h"
#include "support/random_memberships.h"
#include "support/throws.h"

namespace mesamis {
namespace {

/// Triangles that begin with their smallest corner, sorted.
std::vector<std::array<Index, 5>> sorted(const PartitionSurface& partition) {
  std::vector<std::array<Index, 5>> all;
  for (std::size_t t = 0; t < partition.triangles.size(); ++t) {
    Triangle c = partition.triangles[t];
    std::rotate(c.begin(), std::min_element(c.begin(), c.end()), c.end());
    all.push_back({c[0], c[1], c[2], partition.sides[t][0], partition.sides[t][1]});
  }
  std::sort(all.begin(), all.end());
  return all;
}

TEST(GridPartition, IsThePartitionOfTheGridsTetrahedra) {
  for (unsigned seed = 1; seed <= 6; ++seed) {
    const Index materials = 1 + static_cast<Index>(seed);
    const GridMemberships grid = random_grid({5, 4, 6}, materials, seed);
    std::vector<std::vector<double>> fields(static_cast<std::size_t>(materials));
    for (std::size_t i = 0; i < grid.value.size(); ++i) {
      fields[static_cast<std::size_t>(grid.listed[i])].push_back(grid.value[i]);
    }
    const TetMesh mesh = box_mesh({{0, 0, 0}, {4, 6, 2.5}}, {4, 3, 5});
    for (const bool close : {true, false}) {
      const PartitionSurface whole = extract_partition(mesh, fields, {.close_at_box = close});
      const PartitionSurface found = extract_partition_on_grid(grid, {.close_at_box = close});
      EXPECT_EQ(found.points, whole.points) << seed;
      EXPECT_EQ(sorted(found), sorted(whole)) << seed;
    }
  }
}

TEST(GridPartition, NamesTheLabelsOfItsMaterials) {
  GridMemberships grid = random_grid({5, 5, 5}, 4, 9);
  const PartitionSurface plain = extract_partition_on_grid(grid);
  grid.label = {40, 30, 20, 10};
  const PartitionSurface named = extract_partition_on_grid(grid);
  EXPECT_EQ(materials_of(named), (std::vector<Index>{10, 20, 30, 40}));
  expect_partition_laws(named, 4 * 8 * 2, "labels in another order");
  for (Index m = 0; m < 4; ++m) {
    EXPECT_NEAR(check_surface(object_surface(named, 40 - 10 * m)).volume,
                check_surface(object_surface(plain, m)).volume, 1e-12);
  }
}

TEST(GridPartition, HasTheSameBytesForAnyNumberOfThreads) {
  const GridMemberships grid = random_grid({20, 20, 20}, 4, 5);
  const auto one = with_threads(1, [&] { return extract_partition_on_grid(grid); });
  const auto two = with_threads(2, [&] { return extract_partition_on_grid(grid); });
  EXPECT_EQ(one.points, two.points);
  EXPECT_EQ(one.triangles, two.triangles);
  EXPECT_EQ(one.sides, two.sides);
}

TEST(GridPartition, RefusesWhatDoesNotFit) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const auto expect_refused = [](const char* what,
                                 const std::function<void(GridMemberships&)>& spoil) {
    GridMemberships grid = random_grid({3, 3, 3}, 2, 1);
    spoil(grid);
    EXPECT_REFUSED(extract_partition_on_grid(grid), testing::HasSubstr(what));
  };
  using Grid = GridMemberships;
  expect_refused("2 or more nodes", [](Grid& g) { g.size = {27, 1, 1}; });
  expect_refused("fewer than 2^31", [](Grid& g) { g.size = {1 << 30, 1 << 30, 1 << 30}; });
  expect_refused("one material per node", [](Grid& g) { g.material.pop_back(); });
  expect_refused("spacing", [](Grid& g) { g.spacing.y = 0; });
  expect_refused("spacing", [nan](Grid& g) { g.spacing.y = double{nan}; });
  expect_refused("lists", [](Grid& g) { g.first[3] = g.first[5]; });
  expect_refused("one value", [](Grid& g) { g.value.pop_back(); });
  expect_refused("have a label", [](Grid& g) { g.material[4] = 2; });
  expect_refused("have a label", [](Grid& g) { g.listed[4] = -1; });
  expect_refused("labels of 0", [](Grid& g) { g.label[1] = -1; });
  expect_refused("finite", [nan](Grid& g) { g.value[1] = nan; });
}

}  // namespace
}  // namespace mesamis
