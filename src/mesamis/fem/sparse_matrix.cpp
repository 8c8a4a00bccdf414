// SPDX-License-Identifier: Apache-2.0
#include "mesamis/fem/sparse_matrix.h"

#include <algorithm>

namespace mesamis::detail::fem {

SparseMatrix from_triplets(Index rows, std::vector<Triplet> triplets) {
  std::stable_sort(triplets.begin(), triplets.end(), [](const Triplet& a, const Triplet& b) {
    return a.row != b.row ? a.row < b.row : a.column < b.column;
  });
  SparseMatrix matrix;
  matrix.row_start.assign(static_cast<std::size_t>(rows) + 1, 0);
  for (std::size_t i = 0; i < triplets.size(); ++i) {
    const Triplet& t = triplets[i];
    if (i > 0 && triplets[i - 1].row == t.row && triplets[i - 1].column == t.column) {
      matrix.values.back() += t.value;
      continue;
    }
    ++matrix.row_start[static_cast<std::size_t>(t.row) + 1];
    matrix.columns.push_back(t.column);
    matrix.values.push_back(t.value);
  }
  for (std::size_t r = 0; r < matrix.rows(); ++r) matrix.row_start[r + 1] += matrix.row_start[r];
  return matrix;
}

}  // namespace mesamis::detail::fem
