// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "mesamis/rooms.h"
#include "mesamis/surface/tri_mesh.h"

namespace mesamis::detail::surface {

/// Do the triangles share a point of space that is not a common corner or side by their indices?
/// Touching counts. A triangle without area meets nothing here, see has_area(). Exact.
bool intersect(std::span<const Vec3> points, const Triangle& s, const Triangle& t);

/// False if the three corners lie on one line. Exact.
bool has_area(std::span<const Vec3> points, const Triangle& t);

}  // namespace mesamis::detail::surface
