// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "mesamis/base/types.h"
#include "mesamis/rooms.h"

namespace mesamis::detail::decimate {

/// Rounds points of several surfaces to single precision so that the surfaces still fit.
///
/// Equal points stay equal, and different points stay different: of those that become equal by
/// rounding one stays and the others move to the nearest free place. So surfaces that share points
/// still share them, and each surface that was closed and a 2-manifold is so after a reader has
/// joined equal points. round_to_single() then moves no point of theirs.
///
/// @param points  of all surfaces, mm; in any order, which does not matter to where a point goes.
/// @return one point per point; each coordinate is a float's value, and no zero is negative.
/// @throws InputError  if a coordinate is not finite or exceeds single precision.
///
/// O(n log n) for n points.
std::vector<Vec3> round_together(std::span<const Vec3> points);

/// The same in place.
/// @return how far a point moved at most, mm.
double round_in_place(std::vector<Vec3>& points);

}  // namespace mesamis::detail::decimate
