// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "mesamis/base/types.h"
#include "mesamis/rooms.h"

namespace mesamis::detail::base {

/// The lower 21 bits of a number, two zeros between any two of them.
inline std::uint64_t spread_bits(std::uint64_t v) {
  v &= 0x1fffff;
  v = (v | v << 32) & 0x1f00000000ffff;
  v = (v | v << 16) & 0x1f0000ff0000ff;
  v = (v | v << 8) & 0x100f00f00f00f00f;
  v = (v | v << 4) & 0x10c30c30c30c30c3;
  return (v | v << 2) & 0x1249249249249249;
}

/// Where a point comes on a Morton curve through a box: what is near in space is mostly near on it.
/// @param p  in the box, in its unit.
/// @return 63 bits, 21 of each coordinate; those along a side without length are 0.
inline std::uint64_t morton_code(const Box& box, const Vec3& p) {
  constexpr double kSteps = (1 << 21) - 1;
  std::uint64_t code = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double side = box.hi[axis] - box.lo[axis];
    if (!(side > 0)) continue;
    const double t = (p[axis] - box.lo[axis]) / side;
    code |= spread_bits(static_cast<std::uint64_t>(kSteps * t)) << axis;
  }
  return code;
}

}  // namespace mesamis::detail::base
