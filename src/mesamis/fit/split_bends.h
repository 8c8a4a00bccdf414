// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <span>
#include <vector>

#include "mesamis/image/volume.h"
#include "mesamis/rooms.h"
#include "mesamis/surface/tri_mesh.h"

namespace mesamis::detail::fit {

/// Boundaries of several objects, of which edges were split, and where their points shall go.
struct SplitBoundaries {
  TriMesh surface;                          ///< where it was; the points of before come first
  std::vector<std::array<Index, 2>> sides;  ///< of each triangle
  std::vector<Vec3> shifts;                 ///< of each point, to a surface that bends evenly
};

/// Splits the edges at which boundaries bend by more than 15 degrees, so that a coarse surface can
/// follow its own bends.
///
/// A new point lies amid its edge; its shift leads on to the cubic curve through the edge's ends
/// that touches the surface there (Vlachos et al., Curved PN triangles, 2001). Where several
/// boundaries meet, and on the grid's box, a point has no normal: the curve is the parabola of the
/// other end, and edges between two such points stay.
/// @param surface   in the grid's own axes, mm.
/// @param sides     of each triangle: materials behind, in front.
/// @param on_curve  of each point 1 where several boundaries meet.
///
/// O(n) for n triangles. The same bits for any number of threads.
SplitBoundaries split_bends(const TriMesh& surface, std::span<const std::array<Index, 2>> sides,
                            const std::vector<char>& on_curve, const VoxelGrid& grid);

}  // namespace mesamis::detail::fit
