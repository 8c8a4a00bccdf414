// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "mesamis/mesh/tet_mesh.h"
#include "mesamis/rooms.h"

/// Parts of a mesh: sets of cells, and the mesh of such a set.
namespace mesamis::detail::mesh {

/// The volume of all cells, mm^3. O(m) for m cells.
/// @param mesh  mm.
double mesh_volume(const TetMesh& mesh);

/// The mean of a P1 function over each cell, which is its value at the centroid.
/// @param mesh         n nodes, m cells.
/// @param values       n values of any unit.
/// @return m values in the same unit.
/// @throws InputError  if the sizes differ.
std::vector<double> cell_means(const TetMesh& mesh, std::span<const double> values);

/// The share of a cell's volume where a linear function is above zero.
/// @param values  at the cell's nodes, finite, of any unit.
/// @return 0 to 1, no unit.
double share_above_zero(std::array<double, 4> values);

/// Finds the cells with more than half of their volume where a P1 function is above a level.
///
/// No other set of cells differs less in volume from {values > level}: the difference is at most
/// half of each cell that the level set cuts.
///
/// @param mesh         n nodes, m cells.
/// @param values       n values of any unit, finite.
/// @param level        in the same unit, finite.
/// @return indices in increasing order.
/// @throws InputError  if the sizes differ or a number is not finite.
std::vector<Index> cells_mostly_above(const TetMesh& mesh, std::span<const double> values,
                                      double level);

/// Which face-connected parts of a set of cells to keep. A cavity is a face-connected part of the
/// other cells that does not reach the mesh's boundary.
struct CellSelection {
  double volume_min = 0;          ///< mm^3; smaller parts go, smaller cavities are filled
  std::int64_t keep_largest = 0;  ///< parts beyond so many, by volume; 0: all
  bool fill_cavities = false;     ///< every cavity is filled
};

/// Fills cavities of a set of cells, then drops parts of it.
/// @param mesh         m cells, mm.
/// @param cells        indices in [0, m), each once.
/// @return indices in increasing order.
/// @throws InputError  as cell_neighbors(), or if an index is out of range.
///
/// O(m), and O(p log p) for p parts.
std::vector<Index> select_cells(const TetMesh& mesh, std::span<const Index> cells,
                                const CellSelection& selection);

/// Numbers the face-connected parts of the mesh, from 0 in the order of their first cells.
/// @return one number per cell.
/// @throws InputError  as cell_neighbors().
///
/// O(m) for m cells.
std::vector<Index> face_parts(const TetMesh& mesh);

/// Counts the face-connected parts of the mesh.
/// @throws InputError  as cell_neighbors().
///
/// O(m) for m cells.
std::int64_t count_face_parts(const TetMesh& mesh);

/// Some cells of a mesh with the points they use.
struct RestrictedMesh {
  TetMesh mesh;
  std::vector<Index> nodes;  ///< of each point the index in the whole mesh, increasing
};

/// Makes a mesh of some cells; with all cells of a mesh that uses each of its points it is the mesh
/// itself.
/// @param mesh         n nodes, m cells.
/// @param cells        k indices in [0, m), each once; the result has their order.
/// @throws InputError  if an index is out of range.
RestrictedMesh restrict_mesh(const TetMesh& mesh, std::span<const Index> cells);

}  // namespace mesamis::detail::mesh
