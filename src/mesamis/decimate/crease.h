// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>

#include "mesamis/rooms.h"

namespace mesamis::detail::decimate {

/// The cosine of the angle, 25 degrees, from which on an edge is a crease.
inline constexpr double kCrease = 0.9063;

/// The same of 50 degrees: sharper creases are no worse.
inline constexpr double kSharpCrease = 0.6428;

/// Whether a change makes an edge a crease: it bends by more than 25 degrees, and by more than
/// before, but for rounding.
/// @param before, now  cosines between the triangles at the edge; of several edges before, the least.
inline bool makes_crease(double before, double now) noexcept {
  constexpr double kRounding = 1e-6;
  return now < std::min(kCrease, before) - kRounding;
}

}  // namespace mesamis::detail::decimate
