// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "mesamis/surface/signed_distance.h"
#include "mesamis/surface/tri_mesh.h"

namespace mesamis::detail::body {

/// On which side of a surface to measure.
enum class Side {
  kWall,  ///< walls of the object
  kGap,   ///< gaps between its parts
};

/// How wide the wall or the gap is at each point of a surface: the diameter of the largest ball on
/// that side that touches the point, where the ball also touches a part of the surface that faces
/// the other way.
/// @param surface   n points, closed, mm.
/// @param distance  of the same surface.
/// @param most      mm, > 0: wider ones are not looked for.
/// @return n widths, mm; infinite where there is no wall or gap.
/// @throws InputError  as vertex_normals().
///
/// Source: Ma, Bae and Choi, 3D medial axis point approximation using nearest neighbors and the
/// normal field, 2012. O(n log n). The same bits for any number of threads.
std::vector<double> wall_widths(const TriMesh& surface, const SignedDistance& distance, Side side,
                                double most);

}  // namespace mesamis::detail::body
