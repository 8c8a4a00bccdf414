// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "mesamis/remesh/workbench.h"

namespace mesamis::detail::remesh {

/// Gives cells another material until the skin of no object touches itself: around each vertex the
/// cells of a material hang together by faces.
///
/// A cut may leave a wall that is there in one cell and not in the next: it then touches itself in
/// an edge or a vertex. Of what does not hang together around a vertex the largest stays, and the
/// rest becomes what is around it. Two objects may still touch each other in a vertex.
///
/// @param bench  of a mesh whose cells have materials.
/// @return how many cells changed.
///
/// O(cells at the skin).
std::int64_t make_skin_manifold(Workbench& bench);

}  // namespace mesamis::detail::remesh
