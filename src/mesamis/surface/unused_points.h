// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "mesamis/rooms.h"
#include "mesamis/surface/tri_mesh.h"

namespace mesamis::detail::surface {

/// The surface without the points that no triangle uses; the order stays.
/// @param surface  n points, m triangles with indices in range.
TriMesh without_unused_points(const TriMesh& surface);

}  // namespace mesamis::detail::surface
