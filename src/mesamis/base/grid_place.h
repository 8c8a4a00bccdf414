// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "mesamis/base/types.h"

namespace mesamis {

/// The place i, j, k of an item of a grid; i runs fastest. O(1), two divisions.
/// @param size  items along each axis, at least 1; their number fits into the type of n.
/// @param n     of the item, an integer of any type, >= 0.
template <class Number>
std::array<Index, 3> grid_place(const std::array<Index, 3>& size, Number n) noexcept {
  const auto nx = static_cast<Number>(size[0]), ny = static_cast<Number>(size[1]);
  const Number line = n / nx;
  return {static_cast<Index>(n % nx), static_cast<Index>(line % ny), static_cast<Index>(line / ny)};
}

}  // namespace mesamis
