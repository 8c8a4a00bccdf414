// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "mesamis/image/volume.h"
#include "mesamis/rooms.h"
#include "mesamis/surface/tri_mesh.h"

namespace mesamis::detail::study {

/// Selects the triangles whose three points lie inside the volume's box, at least `margin` away
/// from its faces.
/// @param surface  LPS mm; indices in range.
/// @param volume   gives the box, see Volume::box(); its samples are not used.
/// @param margin   mm along each axis of the grid, >= 0.
/// @return LPS mm, in the order of the surface, without unused points; empty if no triangle is
///         inside.  O(n) for n points and triangles.
TriMesh part_inside(const TriMesh& surface, const Volume& volume, const Vec3& margin);

}  // namespace mesamis::detail::study
