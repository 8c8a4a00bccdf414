// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "mesamis/remesh/counters.h"
#include "mesamis/remesh/shape_score.h"

namespace mesamis::detail::remesh {

/// Moves the vertices of a body's skin off the border until its triangles lie as much outside as
/// inside. With all corners on the border of a convex body each triangle cuts a little off.
///
/// A vertex goes along the skin's normal by the mean distance of the border from the triangles
/// around it, at most by the tolerance there, and only if the shapes around keep the rule or become
/// no worse. Vertices where three materials or a plane of the box meet the skin stay.
///
/// O(m) for m cells, and 3 look-ups of the border per triangle at each vertex of the skin.
Counters balance_skin(Workbench& bench, const ShapeRule& rule);

}  // namespace mesamis::detail::remesh
