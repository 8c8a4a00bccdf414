// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "mesamis/object/choose_object.h"

namespace mesamis::detail::report {

/// What a report says under "object" of which object was meant and what was done to the scan for
/// it: tissue, level_from, mask, seeds_mm, removed, padding; docs/formats.md lists the keys.
/// @param request  of choose_object().
/// @param chosen   what it returned.
nlohmann::ordered_json object_json(const ObjectRequest& request, const ChosenObject& chosen);

}  // namespace mesamis::detail::report
