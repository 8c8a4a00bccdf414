// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "mesamis/surface/tri_mesh.h"

namespace mesamis {

/// Unit normals at the points, pointing outward: the mean of the triangles' around each point,
/// weighted by area. Zero where there is no triangle or they cancel out.
/// @throws InputError  as require_sound. O(n).
std::vector<Vec3> vertex_normals(const TriMesh& surface);

}  // namespace mesamis
