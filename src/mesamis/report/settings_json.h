// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>

#include "mesamis/method/settings.h"
#include "mesamis/rooms.h"

namespace mesamis::detail::report {

/// Every setting of setting_table() under its name, as read_settings() reads it.
nlohmann::ordered_json to_json(const Settings& settings);

/// Sets the settings that the object names; the others stay as they are.
/// @throws InputError  for an unknown name, a value of the wrong kind or out of range; the message
///                     names the setting, and what was expected and found.
void from_json(const nlohmann::json& object, Settings& settings);

/// Reads a settings file, or the settings of a report: its entry "settings".
/// @param settings  gives the values of the settings that the file does not name.
/// @return valid settings.
/// @throws InputError  one line that begins with the path, if the file cannot be read, as
///                     from_json(), or if the settings do not fit together.
Settings read_settings(const std::filesystem::path& path, Settings settings);

}  // namespace mesamis::detail::report
