// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "mesamis/rooms.h"
#include "mesamis/surface/tri_mesh.h"

namespace mesamis::detail::surface {

/// How well shaped the triangles of a surface are.
struct TriangleShapes {
  double least_angle = 60;  ///< smallest angle of all triangles, degrees; 60 if none is smaller
  double share_above_30_deg =
      1;  ///< of the triangles, those whose three angles are above 30 degrees
};

/// Measures the angles of all triangles of a surface. A triangle without area has angles of 0.
/// @param surface  n triangles, sound, mm.
/// @return the defaults if there is no triangle.
TriangleShapes triangle_shapes(const TriMesh& surface);

}  // namespace mesamis::detail::surface
