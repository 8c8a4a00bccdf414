// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "mesamis/mesh/metric_field.h"
#include "mesamis/mesh/tet_mesh.h"
#include "mesamis/remesh/remesh.h"

namespace mesamis::detail::remesh {

/// Adapts a piece of a mesh of a box, so that it still fits to the pieces around it: remesh() for
/// meshes that no single memory holds.
///
/// Faces of one cell that do not lie in a plane of the box are the border towards other pieces:
/// their points stay, and no edge between two of them is split. The cells at the border are adapted
/// by a later call for a piece in whose inside they lie.
///
/// @param piece   some cells, or none, of a valid mesh of the box, mm; every point is of a cell.
/// @param box     of the whole mesh, mm.
/// @param metric  in 1/mm^2, defined on the piece; called in threads.
/// @param options  max_cells counts the piece's.
/// @return a mesh of the same place with the same border, points of the border first, all bits of
///         their coordinates kept. The same bits for any number of threads.
/// @throws InputError  if a cell of the piece is not certified positive, or as remesh().
/// @throws Cancelled   if progress returns false.
///
/// Time and memory as remesh().
TetMesh remesh_piece(const TetMesh& piece, const Box& box, const MetricField& metric,
                     const RemeshOptions& options = {});

}  // namespace mesamis::detail::remesh
