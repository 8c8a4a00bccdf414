// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "mesamis/mesh/metric.h"
#include "mesamis/mesh/tet_mesh.h"
#include "mesamis/remesh/remesh.h"

namespace mesamis::detail::remesh {

/// A mesh made for a metric that is known at the nodes of another mesh.
struct AdaptedMesh {
  TetMesh mesh;
  bool kept_start = false;  ///< it was made from the other mesh, not from a coarse box
  RemeshReport report;
  MeshFit fit;  ///< of the mesh to the metric, enlarged by RemeshReport::size_factor
};

/// Adapts a mesh to a metric at its nodes, with one pass of remesh().
///
/// A mesh in which at least half of the edges fit the metric already is the start of the remesher.
/// Another one gives only its box: to refine a coarse box is faster than to coarsen or rebuild a
/// mesh that does not fit.
///
/// @param mesh          n nodes, fills its bounding box, see find_flaw(); mm.
/// @param node_metrics  n symmetric positive definite matrices, in 1/mm^2; interpolated
///                      log-Euclidean and linear on the cells.
/// @return the same bits for any number of threads.
/// @throws InputError  as MeshMetricField and remesh().
/// @throws Cancelled   if the progress of the options says stop.
///
/// Time and memory as remesh(), and a copy of the mesh.
AdaptedMesh adapt_mesh(const TetMesh& mesh, std::span<const Sym3> node_metrics,
                       const RemeshOptions& options = {});

}  // namespace mesamis::detail::remesh
