// SPDX-License-Identifier: Apache-2.0
#include "mesamis/report/settings_json.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "mesamis/base/error.h"
#include "mesamis/files/refuse.h"
#include "mesamis/method/setting_table.h"
#include "mesamis/report/json_file.h"

namespace mesamis::detail::report {
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

/// A bound of a range; null is the volume's own.
bool add_bound(const json& value, double open, std::vector<double>& numbers) {
  if (value.is_null()) numbers.push_back(open);
  return value.is_null() || add_number(value, numbers);
}

/// [I0, I1], [null, I1], [I0, null]; null for the whole axis.
bool add_range(const json& range, std::vector<double>& numbers) {
  if (range.is_null()) {
    numbers.insert(numbers.end(), {0, -1});
    return true;
  }
  return range.is_array() && range.size() == 2 && add_bound(range[0], 0, numbers) &&
         add_bound(range[1], -1, numbers);
}

/// The numbers of a list; of a list of ranges where the setting has them.
bool add_list(const Setting& setting, const json& list, std::vector<double>& numbers) {
  return std::all_of(list.begin(), list.end(), [&](const json& entry) {
    return setting.ranges ? add_range(entry, numbers) : add_number(entry, numbers);
  });
}

/// A word, or numbers as they are written on the command line: "10:20,,".
/// @throws InputError  "expected FORM, found TEXT", without the setting's name.
SettingValue text_value(const Setting& setting, const std::string& text) {
  return setting.count > 0 ? parse_value(setting, text) : SettingValue(text);
}

/// Nothing if no setting has values of this kind.
std::optional<SettingValue> value_in(const Setting& setting, const json& value) {
  if (value.is_boolean()) return value.get<bool>();
  if (value.is_string()) return text_value(setting, value.get<std::string>());
  std::vector<double> numbers;
  const bool read =
      value.is_array() ? add_list(setting, value, numbers) : add_number(value, numbers);
  if (read && !value.is_array() && setting.count == 3) numbers.resize(3, numbers[0]);
  return read ? std::optional<SettingValue>(numbers) : std::nullopt;
}

SettingValue require_value(const Setting& setting, const json& value) {
  std::string found = value.dump();
  try {
    if (auto read = value_in(setting, value)) return *read;
  } catch (const InputError&) {
    found = "'" + value.get<std::string>() + "'";
  }
  throw InputError(setting.name + ": expected " + forms_of(setting) + ", found " + found);
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
    set_setting(settings, setting, require_value(setting, value));
  }
}

Settings read_settings(const std::filesystem::path& path, Settings settings) {
  json file = read_json(path);
  if (file.is_object() && file.contains("settings")) file = file["settings"];
  try {
    from_json(file, settings);
    require_valid(settings);
  } catch (const InputError& error) {
    refuse(path, error.what());
  }
  return settings;
}

}  // namespace mesamis::detail::report
