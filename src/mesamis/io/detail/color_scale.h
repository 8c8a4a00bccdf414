// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>

namespace mesamis::detail {

using Rgb = std::array<std::uint8_t, 3>;

/// The values below which the shares lo and hi of all finite values lie; of a large array an
/// even sample is taken. lo < hi always holds: a constant array gets a range around its value.
struct ValueRange {
  double lo = 0, hi = 1;
};
template <class Value>
ValueRange percentile_range(std::span<const Value> values, double lo, double hi);

/// Black to white.
Rgb grey(double share);

/// Dark blue over green to yellow: evenly spaced to the eye, readable without colour vision.
Rgb viridis(double share);

/// Round numbers inside a range, `about` of them; the step is 1, 2 or 5 times a power of ten.
struct Ticks {
  double first = 0, step = 1;
  int count = 0;
};
Ticks round_ticks(const ValueRange& range, int about);

}  // namespace mesamis::detail
