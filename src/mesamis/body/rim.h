// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "mesamis/base/types.h"
#include "mesamis/image/volume.h"
#include "mesamis/rooms.h"
#include "mesamis/surface/tri_mesh.h"

/// The rim of an object in a scan: its outermost voxels, whose values are mixed with those of the
/// surroundings.
namespace mesamis::detail::body {

/// How deep below its surface an object still shows its surroundings: the scanner's blur, and what
/// the voxels themselves and linear interpolation between them add, half a voxel. At twice the
/// standard deviation of both together, 2 % of the value belong to the surroundings.
/// @param blur  standard deviation along each axis of the grid, voxels, >= 0.
/// @return along each axis of the grid, mm.
Vec3 rim_depth(const VoxelGrid& grid, const std::array<double, 3>& blur);

/// Undoes at the rim of objects what their surroundings took from them: each voxel there gets the
/// value found below, where the object is itself, if that is the greater one.
///
/// A voxel belongs to the rim if it is nearer to the surface than the depth, on either side, or
/// may be the neighbour of a point within the objects. It looks along the normal of the nearest
/// point of all surfaces, down to the depth in that direction; values between voxels are linear
/// along each axis. No value becomes less, and a wall thinner than the depth keeps its own. Where
/// objects end at the border of the scan there are no surroundings, and nothing is changed.
///
/// @param volume    native units, at least 2 voxels along each axis; bright objects.
/// @param surfaces  closed, 2-manifold, oriented outward, world frame (LPS), mm; none: a copy.
/// @param depth     along each axis of the grid, mm, >= 0, see rim_depth(); in a direction between
///                  them that of the ellipsoid. Zero: a copy.
/// @return on the same grid.
/// @throws InputError  as SignedDistance, or if a depth is negative or not finite.
///
/// O(voxels) per surface, O(voxels in the box around each triangle, widened by the depth), and
/// O(log triangles) for each of these voxels once. In threads but for the boxes; the same bits for
/// any number of them. Five bytes per voxel beside the result.
Volume with_full_rim(const VolumeView& volume, std::span<const TriMesh> surfaces,
                     const Vec3& depth);

}  // namespace mesamis::detail::body
