// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "mesamis/rooms.h"

namespace mesamis::detail::picture {

/// Evenly spaced round numbers: first, first + step, ...
struct Ticks {
  double first = 0, step = 1;
  int count = 0;

  double at(int i) const { return first + i * step; }
};

/// Chooses round numbers within a range; the step is 1, 2 or 5 times a power of ten.
///
/// @param lo,hi  lo < hi, finite.
/// @param count  of the ticks, about; >= 1. The result has at most count + 1.
Ticks round_ticks(double lo, double hi, int count);

/// Labels ticks with as many decimals as their step needs, the same number for all of them:
/// "0.0", "0.5", "1.0". Groups the digits of large numbers, "20 000", and writes "2·10⁸" from 1e7
/// on and for steps below 1e-5.
/// @param step  the distance of the ticks, > 0.
std::vector<std::string> tick_labels(const std::vector<double>& ticks, double step);

}  // namespace mesamis::detail::picture
