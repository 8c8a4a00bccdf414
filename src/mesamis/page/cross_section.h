// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

#include "mesamis/image/slice_plane.h"
#include "mesamis/surface/tri_mesh.h"

namespace mesamis::detail::page {

/// A line through points of a page, mm; where it is closed, the first point is the last one too.
using PageLine = std::vector<std::array<double, 2>>;

/// Cuts a surface with the plane of a slice: lines on the page, see to_page(). The lines of a
/// closed surface are closed. They come in the order of the triangles.
/// @param surface  LPS, mm; sound, see require_sound().
///
/// O(n + m log m) for n triangles, m of them cut.
std::vector<PageLine> cross_section(const TriMesh& surface, const VoxelGrid& grid,
                                    const SlicePlane& plane);

/// Where half of a surface's area lies on either side, along an axis: a place at which a slice
/// shows much of it.
/// @param axis  0 x, 1 y, 2 z.
/// @return mm; 0 for surfaces without area. O(n log n).
double middle_of(const std::vector<const TriMesh*>& surfaces, int axis);

}  // namespace mesamis::detail::page
