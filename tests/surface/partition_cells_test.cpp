// SPDX-License-Identifier: Apache-2.0
#include "mesamis/surface/partition_cells.h"

#include <gtest/gtest.h>

#include <random>

namespace mesamis {
namespace {

TEST(PartitionCells, SimplicesHaveTheirNodesInOrder) {
  EXPECT_EQ(simplex_of({7, 2}), (Simplex{2, 7, kNoIndex, kNoIndex}));
  EXPECT_EQ(node_count(simplex_of({7, 2})), 2u);
  EXPECT_EQ(node_count(simplex_of({4, 3, 2, 1})), 4u);
}

TEST(PartitionCells, EqualPointsAreOrthogonalToAllDifferences) {
  std::mt19937 generator(4);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (const std::size_t n : {3U, 4U}) {
    std::array<std::array<double, 4>, 3> d{};
    for (std::size_t i = 0; i + 1 < n; ++i) {
      for (std::size_t j = 0; j < n; ++j) d[i][j] = uniform(generator);
    }
    const std::array<double, 4> w = orthogonal_to(d, n);
    EXPECT_GT(std::abs(w[0]), 0);
    for (std::size_t i = 0; i + 1 < n; ++i) {
      double sum = 0;
      for (std::size_t j = 0; j < n; ++j) sum += w[j] * d[i][j];
      EXPECT_NEAR(sum, 0, 1e-14);
    }
  }
}

TEST(PartitionCells, BlocksAreJoinedAtTheSitesTheyShare) {
  const Simplex a = simplex_of({0, 1}), b = simplex_of({1, 2}), c = simplex_of({2, 0}),
                d = simplex_of({2, 3});
  const std::vector<PartitionPiece> one{{{b, c, a}, {0, 1}}}, two{{{b, a, d}, {1, 4}}};
  const std::vector<PartitionBlock> blocks{block_of(one), block_of(two)};
  const std::vector<Simplex> sites = all_sites(blocks);
  EXPECT_EQ(sites, (std::vector<Simplex>{a, c, b, d}));
  const PartitionSurface partition = over_sites(blocks, sites);
  EXPECT_EQ(partition.triangles, (std::vector<Triangle>{{2, 1, 0}, {2, 0, 3}}));
  EXPECT_EQ(partition.sides, (std::vector<std::array<Index, 2>>{{0, 1}, {1, 4}}));
}

}  // namespace
}  // namespace mesamis
