// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <vector>

#include "mesamis/rooms.h"

namespace mesamis::detail::base {

/// Sorts values in increasing order and leaves each once.
///
/// O(n log n).
template <class Value>
void sort_once(std::vector<Value>& values) {
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
}

/// Appends a value that is not among the others.
///
/// O(n).
template <class Value>
void add_once(std::vector<Value>& values, const Value& value) {
  if (std::find(values.begin(), values.end(), value) == values.end()) values.push_back(value);
}

}  // namespace mesamis::detail::base
