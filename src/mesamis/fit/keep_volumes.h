// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <span>
#include <vector>

#include "mesamis/image/volume.h"
#include "mesamis/surface/tri_mesh.h"

namespace mesamis {

/// Moves the boundaries of several objects so that each has the volume that it had before.
///
/// Each object's boundary moves along its normals by one distance, which Newton's method finds in
/// four steps; a point between two objects moves by the difference of theirs. Material 0, the
/// background, gives and takes. Points on the grid's box stay, and so do those on curves. Moves that
/// would make boundaries meet are taken back.
/// @param before    in the grid's own axes, mm.
/// @param now       the same triangles with their points elsewhere; without self-intersections.
/// @param sides     of each triangle the materials behind and in front.
/// @param on_curve  of each point 1 where several boundaries meet.
/// @return the same triangles.
///
/// O(n log n) for n points. The same bits for any number of threads.
TriMesh keep_volumes(const TriMesh& before, const TriMesh& now,
                     std::span<const std::array<Index, 2>> sides, const VoxelGrid& grid,
                     const std::vector<char>& on_curve);

}  // namespace mesamis
