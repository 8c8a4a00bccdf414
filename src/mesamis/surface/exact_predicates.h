// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "mesamis/base/types.h"
#include "mesamis/rooms.h"

/// Exact answers about points: a static filter in double precision decides nearly always, floating
/// point expansions decide the rest. Exact unless a product over- or underflows.
/// Source: Shewchuk, Adaptive precision floating-point arithmetic and fast robust geometric
/// predicates, 1997.
namespace mesamis::detail::surface {

/// Sign of (b - a) x (c - a) . (d - a): positive when d lies on the side to which the triangle
/// a, b, c turns counter-clockwise.
int orientation(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);

/// Sign of the area of the triangle a, b, c seen along an axis: positive when it turns
/// counter-clockwise in the plane of the axes after it (axis 2: x, y).
int orientation_along(int axis, const Vec3& a, const Vec3& b, const Vec3& c);

}  // namespace mesamis::detail::surface
