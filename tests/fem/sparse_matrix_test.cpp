// SPDX-License-Identifier: Apache-2.0
#include "mesamis/fem/sparse_matrix.h"

#include <gtest/gtest.h>

#include <map>
#include <random>

namespace mesamis {
namespace {

TEST(FromTriplets, AddsUpEqualPlaces) {
  std::mt19937 generator(1);
  std::uniform_int_distribution<Index> place(0, 6);
  std::vector<Triplet> triplets;
  std::map<std::pair<Index, Index>, double> expected;
  for (int n = 0; n < 200; ++n) {
    const Triplet t{place(generator), place(generator), static_cast<double>(n)};
    triplets.push_back(t);
    expected[{t.row, t.column}] += t.value;
  }
  const SparseMatrix matrix = from_triplets(7, triplets);
  ASSERT_EQ(matrix.rows(), 7u);
  std::size_t entries = 0;
  for (Index row = 0; row < 7; ++row) {
    const auto begin = static_cast<std::size_t>(matrix.row_start[static_cast<std::size_t>(row)]);
    const auto end = static_cast<std::size_t>(matrix.row_start[static_cast<std::size_t>(row) + 1]);
    for (std::size_t e = begin; e < end; ++e, ++entries) {
      if (e > begin) {
        EXPECT_LT(matrix.columns[e - 1], matrix.columns[e]);
      }
      EXPECT_EQ(matrix.values[e], (expected.at({row, matrix.columns[e]})));
    }
  }
  EXPECT_EQ(entries, expected.size());
}

TEST(FromTriplets, LeavesRowsEmpty) {
  const SparseMatrix matrix = from_triplets(4, {{2, 1, 5.0}});
  EXPECT_EQ(matrix.row_start, (std::vector<std::int64_t>{0, 0, 0, 1, 1}));
  EXPECT_EQ(from_triplets(3, {}).row_start, (std::vector<std::int64_t>{0, 0, 0, 0}));
}

TEST(FromTriplets, AddsInTheOrderGiven) {
  // 1e16 + 1 - 1e16 depends on the order of the sum.
  const SparseMatrix matrix = from_triplets(1, {{0, 0, 1e16}, {0, 0, 1}, {0, 0, -1e16}});
  EXPECT_EQ(matrix.values, (std::vector<double>{(1e16 + 1) - 1e16}));
}

}  // namespace
}  // namespace mesamis
