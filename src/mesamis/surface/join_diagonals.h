// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "mesamis/surface/smooth_memberships.h"

namespace mesamis::detail::surface {

/// How many slices away labels matter to a DiagonalJoin.
inline constexpr Index kJoinReach = 3;

/// A node of the background that an object may take.
struct DiagonalJoin {
  std::int64_t node = 0;
  Index label = 0;   ///< of the object
  Index change = 0;  ///< of the object's Euler characteristic, when it has those of lower nodes
  std::array<Index, 14> touched{};  ///< parts of the object beside the node; then kNoIndex
};

/// Finds the nodes that close the gaps of no volume in thin objects.
///
/// An object one voxel thick descends along edges and corners of voxels wherever it is oblique to the
/// axes. The Kuhn tetrahedra of the grid join nodes along some diagonals of a cube of 2 x 2 x 2 nodes
/// and cut others, so that slits and tunnels would open in a sheet. Here nodes that touch at a face,
/// an edge or a corner are one object, and the background goes on through faces only. In each cube
/// where the tetrahedra say otherwise, an object takes the fewest nodes of label 0 that mend it, of
/// several those with the most neighbours of the object; but only if one of its nodes in the cube is
/// in no full cube: thick objects that touch at an edge stay apart.
/// @param grid   label 0 is the background.
/// @param parts  of its nodes, see find_label_parts().
/// @return in the order of the nodes, each at most once.
///
/// O(nodes), in threads. The same for any number of them.
std::vector<DiagonalJoin> find_diagonal_joins(const LabelGrid& grid, std::span<const Index> parts);

/// Chooses those that make no handle.
///
/// Nodes that touch each other are taken together or not at all: taken, if they do not lower the
/// Euler characteristic of their object (they close tunnels), or by no more than they join parts that
/// were apart.
/// @param joins  of the whole grid.
/// @param size   nodes along i, j, k.
/// @return in the order of the nodes.
std::vector<DiagonalJoin> choose_joins(std::span<const DiagonalJoin> joins,
                                       const std::array<Index, 3>& size);

/// Gives objects the nodes that they take.
/// @param first   the node that the first label belongs to; nodes beyond the labels do not count.
/// @param labels  one per node from there on; changed.
void take_nodes(std::span<const DiagonalJoin> joins, std::int64_t first,
                std::span<std::uint16_t> labels);

/// All of these.
/// @return the labels, one per node: an object has the nodes that it takes.
std::vector<std::uint16_t> join_diagonals(const LabelGrid& grid);

}  // namespace mesamis::detail::surface
