// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "mesamis/remesh/adapt_mesh.h"

namespace mesamis::detail::report {

/// The entry "mesh" of a report on remeshing: counts, lengths and qualities in the metric, and
/// where the worst cell and edges are; they are numbered from 1 as in Medit files, positions in mm.
/// @param adapted  with a cell at least.
nlohmann::ordered_json fit_json(const AdaptedMesh& adapted);

/// The entry "remesh" of a report on remeshing: rounds, operations and size_factor.
nlohmann::ordered_json remesh_json(const RemeshReport& report);

}  // namespace mesamis::detail::report
