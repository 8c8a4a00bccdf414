// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "mesamis/mesh/tet_mesh.h"
#include "mesamis/page/slice_view.h"
#include "mesamis/picture/raster.h"

namespace mesamis::detail::page {

/// A mesh with a grey value per point.
struct ShownMesh {
  const TetMesh* mesh;           ///< LPS, mm
  std::span<const double> grey;  ///< 0 to 255, one per point
};

/// What is shown of a page.
struct CutRegion {
  PageBox box;
  int pixels = 1000;  ///< along its longer side
};

/// The colour of a grey value: from dark blue by green to light yellow, lighter all the way, so
/// that a grey print can be read.
/// @param grey  0 to 255; bounded to them.
Colour map_colour(double grey);

/// Cuts a mesh with the plane of a slice and draws the cells that it meets: their grey values,
/// linear within each cell, and their edges on the plane.
/// @param grid, plane  of the slice, see to_page().
/// @return white where there is no cell.
///
/// O(cells + pixels covered).
Raster mesh_cut(const ShownMesh& mesh, const VoxelGrid& grid, const SlicePlane& plane,
                const CutRegion& region);

/// The part of a page around what surfaces leave on it, a tenth wider.
/// @param box  of the slice, which the part does not leave; all of it where there are no lines.
PageBox region_around(const std::vector<std::vector<PageLine>>& outlines, const PageBox& box);

}  // namespace mesamis::detail::page
