// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "mesamis/rooms.h"
#include "mesamis/surface/tri_mesh.h"

namespace mesamis::detail::report {

/// Moves the faces of a closed surface that lie on planes of voxel centres outward or inward, so
/// that these centres are inside or outside, all of them. The border of a scan or of a crop cuts
/// objects along such planes, and a file rounds its points to either side of them.
/// @param voxels  the points, in voxels: the planes are those of whole numbers.
/// @param hair    voxels, < 0.25: how far a point of such a face may be from its plane.
/// @param by      voxels outward; inward where negative.
/// @return whether there is such a face.
bool move_centre_faces(std::vector<Vec3>& voxels, std::span<const Triangle> triangles, double hair,
                       double by);

}  // namespace mesamis::detail::report
