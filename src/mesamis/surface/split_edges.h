// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "mesamis/surface/tri_mesh.h"

namespace mesamis {

/// Splits the edges of a surface at their middles until none is longer than a length. The surface
/// stays where it is: new points lie on its triangles. A closed surface stays closed.
/// @param surface  n points, mm or any unit.
/// @param longest  > 0, in multiples of `unit`.
/// @param unit     lengths along the axes that count as one, > 0, in the surface's unit: the sides
///                 of a voxel make edges count in voxels.
/// @throws InputError  as require_sound().
///
/// O(m log m) for m triangles in the end.
TriMesh split_long_edges(TriMesh surface, double longest, const Vec3& unit);

}  // namespace mesamis
