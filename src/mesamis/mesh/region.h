// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "mesamis/mesh/tet_mesh.h"

/// Parts of a mesh: which cells belong to them, and a mesh of these alone.
namespace mesamis {

/// The mean over each cell of the function with these nodal values: that of its four nodes, and
/// its value at the centroid.
/// @param values       one per node.
/// @throws InputError  if the sizes differ.
std::vector<double> cell_means(const TetMesh& mesh, std::span<const double> values);

/// The share of a cell's volume where the linear function with these values at its nodes is above
/// zero, 0 to 1.
double share_above_zero(std::array<double, 4> values);

/// Cells with more than half of their volume where the linear function is above the level, in
/// increasing order. Of all unions of whole cells theirs differs least from {values > level}: by
/// at most half of each cell that is cut, in either direction.
/// @param values       one per node, finite.
/// @throws InputError  if the sizes differ or a number is not finite.
std::vector<Index> cells_mostly_above(const TetMesh& mesh, std::span<const double> values,
                                      double level);

/// Which face-connected parts of a set of cells to keep, cavities being face-connected parts of the
/// other cells that do not reach the mesh's boundary.
struct CellSelection {
  double volume_min = 0;          ///< mm^3; smaller parts go, smaller cavities are filled
  std::int64_t keep_largest = 0;  ///< parts beyond so many, by volume; 0: all
  bool fill_cavities = false;     ///< every cavity is filled
};

/// Fills cavities first, then drops parts.
/// @param cells        indices of cells, each once.
/// @return indices of cells in increasing order.
/// @throws InputError  as cell_neighbors, or for a cell that is not there. O(m).
std::vector<Index> select_cells(const TetMesh& mesh, std::span<const Index> cells,
                                const CellSelection& selection);

/// How many parts the mesh falls into when only cells that share a face hold together.
/// @throws InputError  as cell_neighbors. O(m).
std::int64_t count_face_parts(const TetMesh& mesh);

/// Some cells of a mesh with the points they use; `nodes` are their indices in the mesh they come
/// from. Cells come in the order asked for, points in the order of that mesh: with all cells it is
/// the mesh itself.
struct RestrictedMesh {
  TetMesh mesh;
  std::vector<Index> nodes;
};

/// @throws InputError  for a cell that is not there.
RestrictedMesh restrict_mesh(const TetMesh& mesh, std::span<const Index> cells);

}  // namespace mesamis
