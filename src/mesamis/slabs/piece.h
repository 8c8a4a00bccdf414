// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "mesamis/base/sym3.h"
#include "mesamis/mesh/tet_mesh.h"
#include "mesamis/slabs/archive.h"

namespace mesamis::detail::slabs {

/// What is known at a node.
struct NodeValues {
  double u = 0, v = 0, f = 0;
  Sym3 metric;  ///< 1 / length unit^2
};

/// Some cells of a mesh of the whole box, with the values at their nodes. Pieces have no numbers in
/// common: a node of two pieces is known by its coordinates, which are the same to the bit.
struct Piece {
  TetMesh mesh;
  std::vector<NodeValues> nodes;  ///< one per point of the mesh
};

/// Joins pieces that share no cell. Of a node of several pieces the first one's values stay.
/// O(points and cells).
Piece join(std::span<const Piece* const> pieces);
Piece join(const std::vector<Piece>& pieces);

/// The cells for which `choose` is true, in their order.
Piece select(const Piece& piece, const std::function<bool(const Cell&)>& choose);

void add_piece(ArchiveWriter& archive, const Piece& piece);
/// @throws InputError  as ArchiveReader::next().
Piece next_piece(ArchiveReader& archive);

/// One value of each node: values_of(piece, &NodeValues::u).
template <class Value>
std::vector<Value> values_of(const Piece& piece, Value NodeValues::*which) {
  std::vector<Value> values;
  values.reserve(piece.nodes.size());
  for (const NodeValues& node : piece.nodes) values.push_back(node.*which);
  return values;
}

/// The height of a cell's centroid.
double height_of(const TetMesh& mesh, const Cell& cell);

/// Whether some of the cell is nearer to a height than this.
bool is_near(const TetMesh& mesh, const Cell& cell, double height, double distance);

/// Of each point, a quarter of the volume of the cells around it.
std::vector<double> lumped_mass_of(const TetMesh& mesh);

}  // namespace mesamis::detail::slabs
