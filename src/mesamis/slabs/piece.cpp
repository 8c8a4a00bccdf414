// SPDX-License-Identifier: Apache-2.0
#include "mesamis/slabs/piece.h"

#include <algorithm>
#include <cmath>

#include "mesamis/base/error.h"
#include "mesamis/mesh/region.h"
#include "mesamis/slabs/point_numbers.h"

namespace mesamis::detail::slabs {
Piece join(std::span<const Piece* const> pieces) {
  Piece joined;
  PointNumbers numbers;
  for (const Piece* piece : pieces) {
    std::vector<Index> number(piece->mesh.points.size());
    for (std::size_t n = 0; n < number.size(); ++n) {
      const Vec3& p = piece->mesh.points[n];
      const auto [at, is_new] = numbers.of(p);
      number[n] = at;
      if (!is_new) continue;
      joined.mesh.points.push_back(p);
      joined.nodes.push_back(piece->nodes[n]);
    }
    for (Cell cell : piece->mesh.cells) {
      for (Index& corner : cell) corner = number[corner];
      joined.mesh.cells.push_back(cell);
    }
  }
  return joined;
}

Piece join(const std::vector<Piece>& pieces) {
  std::vector<const Piece*> pointers;
  pointers.reserve(pieces.size());
  for (const Piece& piece : pieces) pointers.push_back(&piece);
  return join(pointers);
}

Piece select(const Piece& piece, const std::function<bool(const Cell&)>& choose) {
  std::vector<Index> cells;
  for (std::size_t c = 0; c < piece.mesh.cells.size(); ++c) {
    if (choose(piece.mesh.cells[c])) cells.push_back(static_cast<Index>(c));
  }
  RestrictedMesh some = restrict_mesh(piece.mesh, cells);
  Piece selected{std::move(some.mesh), {}};
  selected.nodes.reserve(some.nodes.size());
  for (const Index node : some.nodes) selected.nodes.push_back(piece.nodes[node]);
  return selected;
}

void add_piece(ArchiveWriter& archive, const Piece& piece) {
  archive.add(piece.mesh.points);
  archive.add(piece.mesh.cells);
  archive.add(piece.nodes);
}

Piece next_piece(ArchiveReader& archive) {
  Piece piece;
  piece.mesh.points = archive.next<Vec3>();
  piece.mesh.cells = archive.next<Cell>();
  piece.nodes = archive.next<NodeValues>();
  return piece;
}

double height_of(const TetMesh& mesh, const Cell& cell) {
  double sum = 0;
  for (const Index corner : cell) sum += mesh.points[corner].z;
  return sum / 4;
}

bool is_near(const TetMesh& mesh, const Cell& cell, double height, double distance) {
  const auto heights = {mesh.points[cell[0]].z, mesh.points[cell[1]].z, mesh.points[cell[2]].z,
                        mesh.points[cell[3]].z};
  const auto [lowest, highest] = std::minmax(heights);
  return lowest - distance < height && height < highest + distance;
}

std::vector<double> lumped_mass_of(const TetMesh& mesh) {
  std::vector<double> mass(mesh.points.size(), 0);
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    const double quarter = cell_volume(mesh, static_cast<Index>(c)) / 4;
    for (const Index corner : mesh.cells[c]) mass[corner] += quarter;
  }
  return mass;
}

}  // namespace mesamis::detail::slabs
