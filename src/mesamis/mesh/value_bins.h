// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "mesamis/base/types.h"

namespace mesamis {

/// Values sorted into bins of equal width.
struct ValueBins {
  /// n + 1 in increasing order: bin b holds edges[b] <= x < edges[b + 1], the last one also its
  /// end.
  std::vector<double> edges;
  std::vector<Index> of_value;  ///< each value's bin, 0 to n - 1
};

/// @param values       at least one, finite. The bins go from the least to the greatest exactly.
/// @param count        n, at least 1.
/// @throws InputError  otherwise.
ValueBins equal_bins(std::span<const double> values, int count);

}  // namespace mesamis
