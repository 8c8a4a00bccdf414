// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

#include "mesamis/mesh/tet_mesh.h"
#include "mesamis/rooms.h"

namespace mesamis::detail::mesh {

/// Two point indices, the smaller first.
using Edge = std::array<Index, 2>;

/// Lists every edge of the mesh once.
///
/// @param mesh  m cells; point indices in range.
/// @return in increasing order; about 1.2 m edges.
///
/// O(m log d) for at most d cells at a point; 24 bytes per cell beside the result.
std::vector<Edge> unique_edges(const TetMesh& mesh);

}  // namespace mesamis::detail::mesh
