// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "mesamis/report/body_output.h"

namespace mesamis::detail::report {

/// The entry "body" of a report, as docs/formats.md lists it: elements and their shapes, sizes,
/// parts, sets, materials.
nlohmann::ordered_json body_json(const BodyOutput& body);

}  // namespace mesamis::detail::report
