// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "mesamis/rooms.h"
#include "mesamis/surface/tri_mesh.h"

namespace mesamis::detail::surface {

/// Outward normals at the points: the means of the triangles' normals, weighted by area.
/// @param surface      n points, m triangles, mm.
/// @return n vectors of length 1 (no unit); zero where there is no triangle or they cancel out.
/// @throws InputError  as require_sound().
std::vector<Vec3> vertex_normals(const TriMesh& surface);

}  // namespace mesamis::detail::surface
