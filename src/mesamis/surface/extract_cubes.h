// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <span>

#include "mesamis/base/types.h"
#include "mesamis/rooms.h"
#include "mesamis/surface/tri_mesh.h"

namespace mesamis::detail::surface {

/// Values at the nodes of a regular grid.
struct GridValues {
  std::array<Index, 3> size{};      ///< nodes along i, j, k; at least 2 each
  Vec3 spacing;                     ///< between nodes, > 0
  std::span<const float> values{};  ///< one per node, finite; i runs fastest, then j, k
};

/// Extracts the boundary of {values > level} by marching cubes (Lorensen, Cline 1987). It has less
/// than half the triangles of extract_solid() on the grid's tetrahedra, and follows the values less
/// exactly.
///
/// Each cube's part of the boundary consists of loops over its crossed edges. On a face with two
/// corners above the level, across from each other, these are kept apart. A loop of more than four
/// points gets one in its middle. So the surface is closed, 2-manifold, oriented outward, and does
/// not cut itself, for any values. Where {values > level} meets the box of the nodes, it is capped
/// there; along the edges of the box the cap is bevelled by a step of the grid.
///
/// @param level  in the unit of the values, finite.
/// @return points in the unit of the spacing, the first node at the origin; empty if no node within
///         the box is above the level.
/// @throws InputError  if the sizes do not fit, or a value is not finite.
///
/// O(nodes), 12 bytes for each. The same bits for any number of threads.
TriMesh extract_cubes(const GridValues& grid, double level);

}  // namespace mesamis::detail::surface
