// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "mesamis/method/passes.h"
#include "mesamis/surface/tri_mesh.h"

namespace mesamis::detail::method {

/// The solid of the functional's minimum on the first grid, by marching cubes: what can be seen
/// before any mesh is adapted. Records the pass.
/// @return in the grid's own axes, length units; see extract_cubes().
/// @throws Cancelled  if progress says stop.
TriMesh preview_surface(const Pass& pass);

}  // namespace mesamis::detail::method
