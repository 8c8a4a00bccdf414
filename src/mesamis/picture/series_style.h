// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "mesamis/rooms.h"

namespace mesamis::detail::picture {

/// What a series looks like.
struct SeriesStyle {
  const char* color;   ///< "#rrggbb"
  const char* dashes;  ///< value of stroke-dasharray
  const char* marker;  ///< path around the origin
  bool filled;         ///< the marker
};

/// Chooses a style. Consecutive series differ in hue, lightness, dashes and marker, and twenty
/// series in dashes or marker, so that a grey print can be read. The contrast to white is at least
/// 3 : 1.
/// @param number  of the series, from 0.
SeriesStyle series_style(std::size_t number);

}  // namespace mesamis::detail::picture
