// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "mesamis/mesh/tet_mesh.h"
#include "mesamis/report/label_output.h"
#include "mesamis/shape_files/mesh_files.h"

namespace mesamis::detail::report {

/// Finds for each point the object that it lies in.
///
/// The line from the point against x crosses an object's surface inward and outward; the point is
/// inside where that does not cancel out. Where objects overlap, the later one has the point.
/// @param points   world frame, mm, finite.
/// @param objects  closed surfaces.
/// @return the place among the objects; kNoIndex outside of all.
///
/// O(points + triangles + pairs of a triangle and a point that its box covers along x), in threads.
/// The same for any number of them.
std::vector<Index> objects_at(std::span<const Vec3> points, std::span<const FoundObject> objects);

/// Gives each cell of a mesh the object that its centroid lies in: a set for what lies outside,
/// BACKGROUND, and one per object, L and its label and name.
/// @param mesh  world frame, mm.
///
/// Cost as objects_at().
CellSets label_sets(const TetMesh& mesh, std::span<const FoundObject> objects);

}  // namespace mesamis::detail::report
