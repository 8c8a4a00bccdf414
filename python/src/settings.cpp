// SPDX-License-Identifier: Apache-2.0
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <nlohmann/json.hpp>

#include "binding.h"
#include "mesamis/method/setting_table.h"
#include "mesamis/report/settings_json.h"
#include "request.h"

namespace mesamis::python {
namespace {

namespace py = pybind11;

py::dict row_of(const Setting& setting) {
  using namespace py::literals;
  const SettingValue value = setting.get(Settings{});
  const bool is_switch = std::holds_alternative<bool>(value);
  return py::dict("name"_a = setting.name, "group"_a = setting.group, "form"_a = forms_of(setting),
                  "default"_a = text_of(setting, value), "unit"_a = setting.unit,
                  "help"_a = setting.help, "automatic"_a = setting.automatic,
                  "paper"_a = setting.paper, "numbers"_a = setting.count, "whole"_a = setting.whole,
                  "ranges"_a = setting.ranges, "words"_a = setting.words, "switch"_a = is_switch);
}

py::list table() {
  py::list rows;
  for (const Setting& setting : setting_table()) rows.append(row_of(setting));
  return rows;
}

}  // namespace

Settings settings_from(const std::string& preset, const std::string& file,
                       const std::string& json) {
  Settings settings = preset_settings(preset);
  if (!file.empty()) settings = read_settings(file, settings);
  from_json(nlohmann::json::parse(json), settings);
  require_valid(settings);
  return settings;
}

void bind_settings(py::module_& module) {
  module.def("setting_table", &table);
  module.def("preset_names", &preset_names);
  module.def("settings_json",
             [](const std::string& preset, const std::string& file, const std::string& json) {
               return to_json(settings_from(preset, file, json)).dump();
             });
}

}  // namespace mesamis::python
