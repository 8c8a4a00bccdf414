// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "mesamis/remesh/metric_sampler.h"
#include "mesamis/remesh/working_mesh.h"

namespace mesamis::detail::remesh {

/// Cuts a mesh along the border of a body: no cell is of two materials any more.
///
/// An edge that passes through another material, deeper than the tolerance, gets a vertex there:
/// walls and gaps thinner than the cells are kept. Then each edge between two materials is split
/// where it crosses the border, and a cell is of the material of its vertices off the skin.
///
/// @param start  a valid mesh of a box around the body, mm.
/// @param shape  called in threads; the mesh refers to it.
/// @return with metrics and qualities.
/// @throws InputError  if no cell lies inside.
///
/// O(m) for m cells, and a look-up of the border or a few per edge near it.
WorkingMesh cut_along_border(const TetMesh& start, const BodyShape& shape,
                             const MetricSampler& sampler);

}  // namespace mesamis::detail::remesh
