// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>

#include "mesamis/settings.h"

namespace mesamis {

/// Every setting under the name of its option, with underscores. What --settings reads is what
/// the report's "settings" holds.
nlohmann::ordered_json to_json(const Settings& settings);

/// Overwrites the settings that the object names.
/// @throws InputError  for an unknown name or a value of the wrong kind, naming it.
void from_json(const nlohmann::json& object, Settings& settings);

}  // namespace mesamis
