// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <span>
#include <vector>

#include "mesamis/fit/boundary_parts.h"
#include "mesamis/image/volume.h"
#include "mesamis/rooms.h"
#include "mesamis/surface/tri_mesh.h"

namespace mesamis::detail::fit {

/// Boundaries of several objects, of which edges may be split.
struct BentBoundaries {
  const TriMesh& surface;             ///< in the grid's own axes, mm
  Sides sides;                        ///< of each triangle: materials behind, in front
  const std::vector<char>& on_curve;  ///< of each point 1 where several boundaries meet
  /// Of each point 1 or 0: edges between two points of 1 stay whole. Empty: all 0.
  std::span<const char> whole{};
};

/// Boundaries of several objects, of which edges were split, and where their points shall go.
struct SplitBoundaries {
  TriMesh surface;                          ///< where it was; the points of before come first
  std::vector<std::array<Index, 2>> sides;  ///< of each triangle
  std::vector<std::array<Index, 2>> edges;  ///< of each new point the edge that it lies amid
  std::vector<Vec3> shifts;                 ///< of each point, to a surface that bends evenly
};

/// Splits the edges at which boundaries bend by more than 15 degrees, so that a coarse surface can
/// follow its own bends.
///
/// A new point lies amid its edge; its shift leads on to the cubic curve through the edge's ends
/// that touches the surface there (Vlachos et al., Curved PN triangles, 2001). Where several
/// boundaries meet, and on the grid's box, a point has no normal: the curve is the parabola of the
/// other end, and edges between two such points stay.
///
/// O(n) for n triangles. The same bits for any number of threads.
SplitBoundaries split_bends(const BentBoundaries& boundaries, const VoxelGrid& grid);

}  // namespace mesamis::detail::fit
