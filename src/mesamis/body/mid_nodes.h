// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "mesamis/remesh/body.h"

namespace mesamis::detail::body {

/// The mid-side nodes that make the elements of a body quadratic.
struct MidNodes {
  std::vector<Vec3> points;  ///< k nodes, mm
  /// Per cell its nodes in the order of kMidNodeEdges: node i is points[i].
  std::vector<std::array<Index, 6>> of_cell;
  std::int64_t straight = 0;  ///< edges of the skin that had to stay straight
};

/// Puts a node on each edge of a body: in the middle, and on the skin at the nearest point of the
/// border, if that keeps the Jacobian of every element around positive at its nodes and at the
/// integration points of order two; else in the middle too.
/// @param body   m valid cells, mm.
/// @param shape  that the body was made for.
/// @param box    of the body, mm: what lies in its planes stays there.
/// @throws InputError  as cell_neighbors().
///
/// O(m log d), see cell_neighbors(), and a look-up of the border per edge of the skin. The same
/// bits for any number of threads.
MidNodes mid_nodes(const BodyMesh& body, const BodyShape& shape, const Box& box);

/// The least determinant of the Jacobian of a quadratic tetrahedron over its nodes and the
/// integration points of order two: six times the volume for straight edges, mm^3.
/// @param corners  mm.
/// @param middles  in the order of kMidNodeEdges, mm.
double least_jacobian(const std::array<Vec3, 4>& corners, const std::array<Vec3, 6>& middles);

}  // namespace mesamis::detail::body
