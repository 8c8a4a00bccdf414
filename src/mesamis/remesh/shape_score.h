// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "mesamis/remesh/workbench.h"

/// The shape of cells in space, as solvers feel it, whatever the metric.
namespace mesamis::detail::remesh {

/// What shape a cell must have in space, not in the metric: solvers ask for it.
struct ShapeRule {
  double least_angle = 16;        ///< dihedral, degrees
  double greatest_angle = 158;    ///< dihedral, degrees
  double scaled_jacobian = 0.22;  ///< see ElementShape
  double skin_angle = 21;         ///< of triangles whose corners are all on the skin, degrees
  double new_length_max = 3;      ///< a collapse makes no longer edge, in the metric
  int sweeps = 10;
};

/// 1 where the rule is just kept, less where it is not.
double shape_score(const WorkingMesh& mesh, const Cell& points, const ShapeRule& rule);

/// The worst of the cells inside a body; infinite where there is none. Cells outside need only be
/// valid.
double worst_score_inside(const WorkingMesh& mesh, std::span<const Index> cells,
                          const ShapeRule& rule);

/// Whether all cells are positive beyond doubt, and not so flat that their energy drowns others.
bool are_positive(const WorkingMesh& mesh, std::span<const Index> cells);

/// A vertex was moved: its metric and the qualities around it follow.
/// @param ball  the cells around the vertex.
void settle_moved(Workbench& bench, Index vertex, std::span<const Index> ball);

}  // namespace mesamis::detail::remesh
