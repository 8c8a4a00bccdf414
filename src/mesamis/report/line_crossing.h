// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>

#include "mesamis/base/types.h"
#include "mesamis/rooms.h"

namespace mesamis::detail::report {

/// A corner of a triangle, and its number: what is computed of an edge must not depend on the
/// triangle that asks.
struct NumberedCorner {
  Vec3 at;
  Index number = 0;
};

/// Where a triangle crosses a line along x.
struct LineCrossing {
  double x = 0;
  int inward = 0;  ///< 1 inward, -1 outward, for increasing x
};

/// Intersects a triangle, counter-clockwise seen from outside, with the line of all points with
/// that y and z. A line through an edge or a corner crosses what a line beside it would.
/// @return nothing where the line passes beside the triangle or in its plane.
std::optional<LineCrossing> line_crossing(const std::array<NumberedCorner, 3>& triangle, double y,
                                          double z);

}  // namespace mesamis::detail::report
