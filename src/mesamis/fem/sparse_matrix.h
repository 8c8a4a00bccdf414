// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "mesamis/base/types.h"

namespace mesamis {

/// Compressed rows, columns increasing within a row, the diagonal always stored.
struct SparseMatrix {
  std::vector<std::int64_t> row_start;  ///< rows + 1 entries
  std::vector<Index> columns;
  std::vector<double> values;
  std::size_t rows() const { return row_start.size() - 1; }
};

/// Entry (row, column, value); equal places are added in the order they stand in.
struct Triplet {
  Index row, column;
  double value;
};
SparseMatrix from_triplets(Index rows, std::vector<Triplet> triplets);

}  // namespace mesamis
