// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "mesamis/base/types.h"
#include "mesamis/mesh/tet_mesh.h"
#include "mesamis/rooms.h"

namespace mesamis::detail::mesh {

/// Limits how fast the sizes of nodal metrics grow from node to node.
///
/// A metric becomes finer where a neighbour is much finer; the shape of the finer metric spreads
/// with it.
/// Along edge e the metric M of one end may be coarsened at the other end to
///     (1 + l ln(gradation))^-2 M,   l = sqrt(e'Me),
/// so that all sizes grow linearly with distance, in the mesh by about the factor `gradation` from
/// one edge to the next; each node keeps the intersection, see intersect(), of its own metric and
/// the bounds from its neighbours. No metric becomes coarser, and a graded field does not change.
/// Source: F. Alauzet, Size gradation control of anisotropic meshes, 2010, growth homogeneous in
/// metric space.
///
/// @param mesh          n nodes, mm; positive cells.
/// @param node_metrics  n positive definite matrices in 1/mm^2, aspects up to about 1e5; changed in
///                      place, by more than 0.1 % of a size or not at all. The same bits for any
///                      number of threads.
/// @param gradation     > 1, no unit.
/// @return the number of nodes that changed.
/// @throws InputError   if the sizes differ, a metric is not finite or not positive definite, or
///                      the gradation is not above 1.
///
/// O(m) per sweep over m cells; as many sweeps as edges lie between a fine node and the last one
/// that it changes. Memory: two metrics per node and the cells around each.
std::int64_t limit_gradation(const TetMesh& mesh, std::span<Sym3> node_metrics, double gradation);

}  // namespace mesamis::detail::mesh
