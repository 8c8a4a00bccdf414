// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

#include "mesamis/body/body_options.h"
#include "mesamis/remesh/body.h"

namespace mesamis::detail::body {

/// A face as its cell and the local vertex opposite it.
using CellFace = std::array<Index, 2>;

/// Finds the faces of a body that a query means, on its boundary or between two objects.
///
/// Each component of the boundary, connected by edges, is outer or inner as a whole: outer if its
/// faces look away from the volume they enclose. A cavity that touches the outside at an edge is
/// one with it.
/// @param body  m cells, in the frame of the query, mm.
/// @return by cell and face; of a face between two objects that of the first one named. There may
///         be none.
/// @throws InputError  as cell_neighbors().
///
/// O(m log d), see cell_neighbors().
std::vector<CellFace> find_faces(const BodyMesh& body, const FaceQuery& query);

}  // namespace mesamis::detail::body
