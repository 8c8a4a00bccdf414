// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <span>
#include <vector>

#include "mesamis/base/types.h"
#include "mesamis/mesh/tet_mesh.h"

namespace mesamis {

/// Where a point lies in a mesh: its cell and its barycentric coordinates there, which are
/// never negative and add up to 1.
struct Location {
  Index cell = kNoIndex;
  std::array<double, 4> weights{0, 0, 0, 0};
};

/// Finds the cell that holds a point, walking from cell `start` through the faces the point
/// lies behind. It cannot miss: should the walk circle or leave, all cells are tried, and the
/// one the point violates least is taken.
///
/// @param mesh       fills a convex box, positive cells.
/// @param neighbors  cell_neighbors(mesh).
/// @param p          mm; outside the box the nearest cell's clamped weights are returned.
Location locate(const TetMesh& mesh, std::span<const std::array<Index, 4>> neighbors, const Vec3& p,
                Index start);

}  // namespace mesamis
