// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "mesamis/base/types.h"
#include "mesamis/rooms.h"

namespace mesamis::detail::mesh {

/// Values sorted into bins of equal width.
struct ValueBins {
  /// n + 1 in increasing order: bin b holds edges[b] <= x < edges[b + 1], the last one also its
  /// end.
  std::vector<double> edges;
  std::vector<Index> of_value;  ///< each value's bin, 0 to n - 1
};

/// Sorts values into bins of equal width from the least value to the greatest.
/// @param values       m >= 1 values of any unit, finite.
/// @param count        n >= 1 bins.
/// @throws InputError  if there is no value or no bin, or a value is not finite.
///
/// O(m log n).
ValueBins equal_bins(std::span<const double> values, int count);

}  // namespace mesamis::detail::mesh
