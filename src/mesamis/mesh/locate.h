// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <span>
#include <vector>

#include "mesamis/base/types.h"
#include "mesamis/mesh/tet_mesh.h"
#include "mesamis/rooms.h"

namespace mesamis::detail::mesh {

/// Where a point lies in a mesh: its cell and its barycentric coordinates there, which are
/// never negative and add up to 1.
struct Location {
  Index cell = kNoIndex;
  std::array<double, 4> weights{0, 0, 0, 0};
};

/// What the cells of a mesh fill.
enum class MeshExtent {
  kBox,
  kPiece  ///< part of a box, with a ragged border
};

/// Finds the cell that holds a point.
///
/// The search walks from cell `start` through faces that have the point on their outer side. If the
/// walk circles or leaves the mesh, the cells around its end are tried, then all cells; the result
/// is then the cell whose least barycentric coordinate is largest.
///
/// @param mesh       m positive cells that fill a box, mm; m > 0.
/// @param neighbors  m entries, cell_neighbors(mesh).
/// @param p          mm; outside the box the weights are clamped to those of the nearest cell.
/// @param start      0 to m - 1.
///
/// O(m^(1/3)) cells on the way across a mesh, O(1) from a cell nearby; O(m) outside the box.
Location locate(const TetMesh& mesh, std::span<const std::array<Index, 4>> neighbors, const Vec3& p,
                Index start);

/// The same in a piece of a mesh: where the walk ends, only the cells around are tried, for the
/// point may lie outside.
/// @param mesh, neighbors, start  as for locate(); the cells are a piece of a box, mm.
/// @param p  mm.
///
/// O(m^(1/3)), O(1) from a cell nearby.
Location locate_in_piece(const TetMesh& mesh, std::span<const std::array<Index, 4>> neighbors,
                         const Vec3& p, Index start);

}  // namespace mesamis::detail::mesh
