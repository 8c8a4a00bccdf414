// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "mesamis/report/meshing_surface.h"

namespace mesamis::detail::report {

/// The entry "meshing" of a surface in a report, as docs/formats.md lists it.
nlohmann::ordered_json meshing_json(const MeshingQuality& quality);

}  // namespace mesamis::detail::report
