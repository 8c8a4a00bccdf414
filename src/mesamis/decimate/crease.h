// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>

namespace mesamis {

/// Whether a change makes an edge a crease: it bends by more than 25 degrees, and by more than
/// before, but for rounding.
/// @param before, now  cosines between the triangles at the edge; of several edges before, the least.
inline bool makes_crease(double before, double now) noexcept {
  constexpr double kSharpest = 0.9063, kRounding = 1e-6;
  return now < std::min(kSharpest, before) - kRounding;
}

}  // namespace mesamis
