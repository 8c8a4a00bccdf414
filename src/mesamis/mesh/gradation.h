// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "mesamis/base/types.h"
#include "mesamis/mesh/tet_mesh.h"

namespace mesamis {

/// Limits how fast the sizes of nodal metrics grow from node to node, by making them finer where
/// a neighbour is much finer; the shape of the finer metric spreads with it.
///
/// Along edge e the metric M of one end may be coarsened at the other end to
///     (1 + l ln(gradation))^-2 M,   l = sqrt(e'Me),
/// so that all sizes grow linearly with distance, in the mesh by about the factor `gradation` from
/// one edge to the next; each node keeps the intersection, see intersect(), of its own metric and
/// what its neighbours allow. Nothing gets coarser, and what is graded already stays as it is.
/// Source: F. Alauzet, Size gradation control of anisotropic meshes, 2010, growth homogeneous in
/// metric space.
///
/// @param node_metrics  positive definite with aspects up to about 1e5, one per node; changed in
///                      place, by more than 0.1 % of a size or not at all. The same bits for any
///                      number of threads.
/// @param gradation     > 1.
/// @throws InputError   if the sizes differ, a metric is not finite or not positive definite, or
///                      the gradation is not above 1.
/// @return the number of nodes that changed.
std::int64_t limit_gradation(const TetMesh& mesh, std::span<Sym3> node_metrics, double gradation);

}  // namespace mesamis
