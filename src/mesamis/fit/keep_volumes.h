// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "mesamis/fit/boundary_parts.h"
#include "mesamis/image/volume.h"
#include "mesamis/rooms.h"
#include "mesamis/surface/tri_mesh.h"

namespace mesamis::detail::fit {

/// Boundaries of several objects, and the volumes that these shall have.
struct ObjectBoundaries {
  const TriMesh& surface;             ///< in the grid's own axes, mm; without self-intersections
  Sides sides;                        ///< of each triangle: materials behind, in front
  const std::vector<char>& on_curve;  ///< of each point 1 where several boundaries meet
  std::span<const double> volumes;    ///< of each material, mm^3
  std::span<const Vec3> shifts{};     ///< of points, which are made first; empty: none
};

/// Finds moves of the boundaries of several objects by which each gets its volume, as far as small
/// moves can do that.
///
/// Each object's boundary moves along its normals by one distance, at most 0.4 voxels, which
/// Newton's method finds in four steps; a point between two objects moves by the difference of
/// theirs. Material 0, the background, gives and takes, and so do those whose volume is not told.
/// Points on the grid's box stay, and so do those on curves; beside curves moves fade, so that no
/// step comes about. Nothing keeps boundaries from meeting.
/// @return of each point its shift, mm, with that which is made first.
/// @throws InputError  if there are shifts, but not one for each point.
///
/// O(n) for n points. The same bits for any number of threads.
std::vector<Vec3> keep_volumes(const ObjectBoundaries& boundaries, const VoxelGrid& grid);

}  // namespace mesamis::detail::fit
