// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "mesamis/base/types.h"
#include "mesamis/rooms.h"

namespace mesamis::detail::fem {

/// Compressed rows, columns increasing within a row, the diagonal always stored.
struct SparseMatrix {
  std::vector<std::int64_t> row_start;  ///< rows + 1 entries
  std::vector<Index> columns;
  std::vector<double> values;
  /// The number of rows; row_start must have its entries.
  std::size_t rows() const noexcept { return row_start.size() - 1; }
};

/// One entry of a matrix.
struct Triplet {
  Index row, column;
  double value;
};

/// Assembles a matrix. Values of the same place are added in the order given.
/// @param rows      number of rows and columns.
/// @param triplets  within the matrix; each row should have its diagonal.
///
/// O(t log t) for t triplets.
SparseMatrix from_triplets(Index rows, std::vector<Triplet> triplets);

}  // namespace mesamis::detail::fem
