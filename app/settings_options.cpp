// SPDX-License-Identifier: Apache-2.0
#include "settings_options.h"

#include <CLI/CLI.hpp>
#include <algorithm>

#include "arguments.h"
#include "mesamis/base/error.h"
#include "mesamis/method/setting_table.h"
#include "mesamis/report/settings_json.h"

namespace mesamis {
namespace {

std::string option_of(const Setting& setting, char mark) {
  std::string name = setting.name;
  std::replace(name.begin(), name.end(), '_', mark);
  return "--" + name;
}

/// Notes a value that was given.
void note(SettingsArguments& arguments, const Setting& setting, const std::string& text,
          const std::string& option) {
  arguments.overrides.push_back({setting.name, text, option});
}

void add_switch(CLI::App& command, const Setting& setting, SettingsArguments& arguments,
                char mark) {
  const std::string yes = option_of(setting, mark), no = option_against(setting, mark);
  const auto add = [&](const std::string& option, const std::string& text,
                       const std::string& help) {
    return command
        .add_flag_callback(
            option,
            [&setting, option, text, &arguments] { note(arguments, setting, text, option); }, help)
        ->group(setting.group);
  };
  add(yes, "yes", help_of(setting))->excludes(add(no, "no", "Not " + yes));
}

void add_value(CLI::App& command, const Setting& setting, SettingsArguments& arguments, char mark) {
  const std::string option = option_of(setting, mark);
  command
      .add_option_function<std::string>(
          option,
          [&setting, option, &arguments](const std::string& text) {
            note(arguments, setting, text, option);
          },
          help_of(setting))
      ->type_name(forms_of(setting))
      ->group(setting.group);
}

/// Errors name the option as it was written.
void apply_override(Settings& settings, const SettingsArguments::Override& override) {
  const Setting& setting = find_setting(override.name);
  parsed(override.option, [&] {
    const SettingValue value = parse_value(setting, override.text);
    check_value(setting, value);
    setting.set(settings, value);
  });
}

}  // namespace

std::string option_against(const Setting& setting, char mark) {
  return "--no" + std::string(1, mark) + option_of(setting, mark).substr(2);
}

bool is_switch(const Setting& setting) {
  return std::holds_alternative<bool>(setting.get(Settings{}));
}

std::string help_of(const Setting& setting) {
  std::string facts = setting.unit.empty() ? "" : setting.unit + "; ";
  facts += "default " + text_of(setting, setting.get({}));
  return setting.help + " (" + facts + ")";
}

void add_settings_options(CLI::App& command, SettingsArguments& arguments, char mark) {
  command.add_option("--preset", arguments.preset, "Settings to start from (default: default)")
      ->check(CLI::IsMember(preset_names()));
  command.add_option("--settings", arguments.file, "Settings or a report: .json");
  for (const Setting& setting : setting_table()) {
    if (is_switch(setting)) {
      add_switch(command, setting, arguments, mark);
    } else {
      add_value(command, setting, arguments, mark);
    }
  }
}

Settings settings_of(const SettingsArguments& arguments) {
  Settings settings = preset_settings(arguments.preset);
  if (!arguments.file.empty()) settings = read_settings(arguments.file, settings);
  for (const auto& override : arguments.overrides) apply_override(settings, override);
  as_usage([&] { require_valid(settings); });
  return settings;
}

void add_frame_option(CLI::App& command, Frame& frame) {
  command
      .add_option_function<std::string>(
          "--frame",
          [&frame](const std::string& name) { frame = name == "ras" ? Frame::kRas : Frame::kLps; },
          "Frame of the files written (default lps)")
      ->check(CLI::IsMember({"lps", "ras"}));
}

CropRange parse_crop(const std::string& text, const std::string& option) {
  Settings settings;
  parsed(option, [&] {
    set_setting(settings, find_setting("crop"), parse_value(find_setting("crop"), text));
  });
  return settings.crop;
}

}  // namespace mesamis
