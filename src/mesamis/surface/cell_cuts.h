// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

#include "mesamis/surface/extract.h"

/// How surfaces cut cells, of one material and of many.
namespace mesamis::detail::surface {

/// The first two corners of each kCellEdges pair with the other two corners in the order that
/// makes the four an even permutation.
inline constexpr std::array<std::array<std::size_t, 4>, 6> kEvenPairs{
    {{0, 1, 2, 3}, {0, 2, 3, 1}, {0, 3, 1, 2}, {1, 2, 0, 3}, {1, 3, 2, 0}, {2, 3, 0, 1}}};

/// A crossing at the share t of an edge, kept off the edge's ends; at the first where t is no
/// number.
inline double kept_off_ends(double t) noexcept {
  return t > kCrossingMargin ? std::min(t, 1 - kCrossingMargin) : kCrossingMargin;
}

/// The same of a linear function that is `level` between the values at the ends.
inline double crossing_share(double level, double from, double to) noexcept {
  // Halves, since the difference of two large values may overflow.
  return kept_off_ends((0.5 * level - 0.5 * from) / (0.5 * to - 0.5 * from));
}

}  // namespace mesamis::detail::surface
