// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "mesamis/rooms.h"
#include "mesamis/surface/tri_mesh.h"

namespace mesamis::detail::body {

/// The places of a surface that lie too far from another, such as tips that a skin cuts off.
/// @param surface    mm.
/// @param other      at least one triangle, mm.
/// @param tolerance  mm, > 0.
/// @return points of those triangles that somewhere lie farther than the tolerance from the other
///         surface, about a quarter of it apart, mm: those farther than 0.85 of it, so that there
///         is one at least for each place; in the order of the triangles.
///
/// O(n log m) for n triangles near m others. The same for any number of threads.
std::vector<Vec3> missed_places(const TriMesh& surface, const TriMesh& other, double tolerance);

}  // namespace mesamis::detail::body
