// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "mesamis/picture/raster.h"

namespace mesamis::detail::picture {

struct ValueRange {
  double lo = 0, hi = 1;  ///< lo < hi
};

/// The range between two percentiles of the finite values.
///
/// Of more than 2^20 values, an even sample is taken. A range without extent becomes that of all
/// values, or one around their only value; without a finite value it is 0 to 1.
/// @param lo,hi  shares of the values that lie below the ends of the range, 0 <= lo < hi <= 1.
///
/// O(n) for n values.
template <class Value>
ValueRange percentile_range(std::span<const Value> values, double lo, double hi);

/// Black at 0 to white at 1; clamped beyond.
Colour grey(double share);

/// Matplotlib's viridis, lightened: violet at 0, green, yellow at 1; clamped beyond. Perceptually
/// uniform, and monotonic in lightness, so that it can be read without colour vision.
Colour viridis(double share);

}  // namespace mesamis::detail::picture
