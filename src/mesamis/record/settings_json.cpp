// SPDX-License-Identifier: Apache-2.0
#include "mesamis/record/settings_json.h"

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "mesamis/base/error.h"
#include "mesamis/method/setting_table.h"
#include "mesamis/record/json_file.h"

namespace mesamis {
namespace {

using nlohmann::json;
using nlohmann::ordered_json;

ordered_json number_json(const Setting& setting, double number) {
  return setting.whole ? ordered_json(static_cast<std::int64_t>(number)) : ordered_json(number);
}

ordered_json numbers_json(const Setting& setting, const std::vector<double>& numbers) {
  if (numbers.size() == 1) return number_json(setting, numbers[0]);
  ordered_json list = ordered_json::array();
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    ordered_json number = number_json(setting, numbers[i]);
    if (!setting.ranges) {
      list.push_back(number);
    } else if (i % 2 == 0) {
      list.push_back(ordered_json::array({number}));
    } else {
      list.back().push_back(number);
    }
  }
  return list;
}

ordered_json value_json(const Setting& setting, const SettingValue& value) {
  if (const auto* on = std::get_if<bool>(&value)) return *on;
  if (const auto* word = std::get_if<std::string>(&value)) return *word;
  return numbers_json(setting, std::get<std::vector<double>>(value));
}

/// Adds a number, or nothing where there is none.
bool add_number(const json& value, std::vector<double>& numbers) {
  if (value.is_number()) numbers.push_back(value.get<double>());
  return value.is_number();
}

/// The numbers of a list; of a list of pairs where the setting has ranges.
bool add_list(const Setting& setting, const json& list, std::vector<double>& numbers) {
  return std::all_of(list.begin(), list.end(), [&](const json& entry) {
    if (!setting.ranges) return add_number(entry, numbers);
    return entry.is_array() && entry.size() == 2 && add_number(entry[0], numbers) &&
           add_number(entry[1], numbers);
  });
}

/// Nothing if no setting has values of this kind.
std::optional<SettingValue> value_in(const Setting& setting, const json& value) {
  if (value.is_boolean()) return value.get<bool>();
  if (value.is_string()) return value.get<std::string>();
  std::vector<double> numbers;
  const bool read =
      value.is_array() ? add_list(setting, value, numbers) : add_number(value, numbers);
  if (read && !value.is_array() && setting.count == 3) numbers.resize(3, numbers[0]);
  return read ? std::optional<SettingValue>(numbers) : std::nullopt;
}

}  // namespace

ordered_json to_json(const Settings& settings) {
  ordered_json object;
  for (const Setting& setting : setting_table()) {
    object[setting.name] = value_json(setting, setting.get(settings));
  }
  return object;
}

void from_json(const json& object, Settings& settings) {
  if (!object.is_object()) throw InputError("expected a JSON object");
  for (const auto& [name, value] : object.items()) {
    const Setting& setting = find_setting(name);
    const auto read = value_in(setting, value);
    if (!read) {
      throw InputError(name + ": expected " + forms_of(setting) + ", found " + value.dump());
    }
    set_setting(settings, setting, *read);
  }
}

Settings read_settings(const std::filesystem::path& path, Settings settings) {
  json file = read_json(path);
  if (file.is_object() && file.contains("settings")) file = file["settings"];
  try {
    from_json(file, settings);
    require_valid(settings);
  } catch (const InputError& error) {
    throw InputError(path.string() + ": " + error.what());
  }
  return settings;
}

}  // namespace mesamis
