// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

#include "mesamis/mesh/tet_mesh.h"

namespace mesamis {

/// Two point indices, the smaller first.
using Edge = std::array<Index, 2>;

/// Every edge of the mesh once, in increasing order.
std::vector<Edge> unique_edges(const TetMesh& mesh);

}  // namespace mesamis
