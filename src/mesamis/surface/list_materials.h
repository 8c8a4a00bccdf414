// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "mesamis/surface/grid_partition.h"

namespace mesamis::detail::surface {

/// Lists, at each node beside a boundary between materials, its own material first and those of its
/// 14 neighbours, each once: what GridMemberships promises.
/// @param grid  its size and materials are read; first and listed are set, all values are 0.
///
/// O(nodes), in threads. The same lists for any number of them.
void list_materials(GridMemberships& grid);

}  // namespace mesamis::detail::surface
