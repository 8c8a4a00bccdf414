// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "mesamis/mesh/tet_mesh.h"
#include "mesamis/rooms.h"

namespace mesamis::detail::surface {

/// A mesh's nodes, some of them moved onto a level set.
struct SnappedNodes {
  std::vector<Vec3> points;    ///< of all nodes, in the unit of the mesh
  std::vector<char> on_level;  ///< 1: the node was moved onto the level set
};

/// Moves nodes onto the level set of u, so that all crossings of their edges become one point: about
/// half the triangles carry the same shape (after isosurface stuffing, Labelle and Shewchuk 2007).
///
/// A node goes to the mean of the crossings of its edges, weighted by 1 / t^2 for a crossing at the share
/// t of an edge; the nodes with the least t first. It is moved if it lies inside the mesh, every cell
/// around it keeps a fifth of its volume, the surface still goes once around it and around each moved
/// node beside it, and all crossings of their edges lie within the distance of it. So the surface keeps
/// its topology, and does not cut itself.
/// @param mesh      a valid mesh or a part of one, n nodes, m cells.
/// @param u         n values of any unit, finite.
/// @param level     in the unit of u, finite.
/// @param distance  unit of the mesh, > 0.
///
/// O(m + n log n). The same bits for any number of threads.
SnappedNodes snap_nodes(const TetMesh& mesh, std::span<const double> u, double level,
                        double distance);

}  // namespace mesamis::detail::surface
