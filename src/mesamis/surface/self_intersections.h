// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

#include "mesamis/surface/tri_mesh.h"

namespace mesamis {

/// Finds the pairs of triangles that share a point of space other than a common corner or side.
///
/// A triangle without area is paired with itself. Points are distinguished by their index: two
/// points at the same place touch, and touching counts. Exact: the result does not depend on
/// rounding, see exact_predicates.h.
///
/// @param surface  n triangles.
/// @return each pair once, the smaller index first, in ascending order.
/// @throws InputError  as require_sound().
///
/// O(n log n) for a surface that rarely meets itself.
std::vector<std::array<Index, 2>> find_self_intersections(const TriMesh& surface);

}  // namespace mesamis
