// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "mesamis/base/types.h"
#include "mesamis/mesh/tet_mesh.h"
#include "mesamis/rooms.h"

namespace mesamis::detail::mesh {

/// The six orders in which a brick's main diagonal can be walked along the axes; each walk's
/// four corners are one Kuhn tetrahedron.
inline constexpr std::array<std::array<int, 3>, 6> kKuhnPaths{
    {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}}};

/// Whether the path is an odd permutation of the axes: its walk gives a negatively oriented cell.
inline constexpr bool kuhn_path_is_odd(const std::array<int, 3>& path) {
  return (path[0] > path[1]) != ((path[1] > path[2]) != (path[0] > path[2]));
}

/// The positively oriented cell of one path.
/// @param corner  the index of the brick's lowest node.
/// @param stride  what one step along each axis adds to a node's index.
/// @param path    one of kKuhnPaths.
inline Cell kuhn_cell(Index corner, const std::array<Index, 3>& stride,
                      const std::array<int, 3>& path) noexcept {
  const Index a = corner + stride[path[0]];
  const Index b = a + stride[path[1]];
  const Index c = b + stride[path[2]];
  return kuhn_path_is_odd(path) ? Cell{corner, a, c, b} : Cell{corner, a, b, c};
}

/// The steps from a node to the seven neighbours above it in the Kuhn tetrahedra of a grid.
inline constexpr std::array<std::array<Index, 3>, 7> kKuhnSteps{
    {{1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}, {1, 1, 1}}};

}  // namespace mesamis::detail::mesh
