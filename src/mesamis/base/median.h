// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <vector>

#include "mesamis/rooms.h"

namespace mesamis::detail::base {

/// Finds the median; of an even count the upper of the two values in the middle.
/// @param values  n >= 1 values of any unit; their order changes.
/// @return in the same unit.
template <class Real>
Real median(std::vector<Real>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace mesamis::detail::base
