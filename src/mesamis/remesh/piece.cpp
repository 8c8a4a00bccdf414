// SPDX-License-Identifier: Apache-2.0
#include "mesamis/remesh/piece.h"

#include <string>

#include "mesamis/base/error.h"
#include "mesamis/mesh/predicates.h"
#include "mesamis/remesh/remesher.h"

namespace mesamis::detail::remesh {
namespace {

void require_positive_cells(const TetMesh& piece) {
  for (std::size_t c = 0; c < piece.cells.size(); ++c) {
    const auto [p, q, r, s] = cell_corners(piece, piece.cells[c]);
    if (certified_positive(p, q, r, s)) continue;
    throw InputError("remesh: cell " + std::to_string(c) +
                     " of the piece has no certified positive volume");
  }
}

/// Freezes the points of the faces that other pieces share.
void freeze_border(WorkingMesh& mesh) {
  mesh.is_part = true;
  for (const WorkCell& cell : mesh.cells) {
    for (std::size_t f = 0; f < 4; ++f) {
      if (cell.neighbors[f] != kNoIndex) continue;
      const auto& [a, b, c] = kCellFaces[f];
      auto mask = [&](int corner) -> std::uint8_t& {
        return mesh.vertices[cell.points[corner]].mask;
      };
      if ((mask(a) & mask(b) & mask(c) & kPlanes) != 0) continue;
      for (const int corner : {a, b, c}) mask(corner) |= kFrozen;
    }
  }
}

}  // namespace

TetMesh remesh_piece(const TetMesh& piece, const Box& box, const MetricField& metric,
                     const RemeshOptions& options) {
  if (piece.cells.empty()) return {};
  require_positive_cells(piece);
  WorkingMesh mesh = load(piece, box);
  freeze_border(mesh);
  Remesher remesher(std::move(mesh), {metric, box}, options);
  remesher.adapt();
  remesher.polish();
  return unload(remesher.result());
}

}  // namespace mesamis::detail::remesh
