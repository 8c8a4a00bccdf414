// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

#include "mesamis/rooms.h"
#include "mesamis/surface/tri_mesh.h"

namespace mesamis::detail::surface {

/// Normals at the corners of triangles for smooth shading that keeps sharp edges: at each point the
/// mean, weighted by area, over those of its triangles that are connected by edges which are not
/// sharp.
/// @param surface    sound indices.
/// @param angle_deg  edges with a larger angle between the normals of their triangles are sharp, as
///                   are those of one triangle or of more than two; 0 to 180.
/// @return one per triangle and corner, of length 1; zero where they cancel out.
///
/// O(m log d) for m triangles, at most d at a point; 150 bytes per triangle.
std::vector<std::array<Vec3, 3>> crease_normals(const TriMesh& surface, double angle_deg);

}  // namespace mesamis::detail::surface
