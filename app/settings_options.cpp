// SPDX-License-Identifier: Apache-2.0
#include "settings_options.h"

#include <algorithm>

#include "arguments.h"
#include "mesamis/base/error.h"
#include "mesamis/method/setting_table.h"
#include "mesamis/record/settings_json.h"

namespace mesamis {
namespace {

std::string option_of(const Setting& setting) {
  std::string name = setting.name;
  std::replace(name.begin(), name.end(), '_', '-');
  return "--" + name;
}

/// "Standard deviation of the noise (native; default auto)"
std::string help_of(const Setting& setting) {
  std::string facts = setting.unit.empty() ? "" : setting.unit + "; ";
  facts += "default " + text_of(setting, setting.get({}));
  return setting.help + " (" + facts + ")";
}

bool is_switch(const Setting& setting) {
  return std::holds_alternative<bool>(setting.get(Settings{}));
}

void add_switch(CLI::App& command, const Setting& setting, SettingsArguments& arguments) {
  const std::string yes = option_of(setting), no = "--no-" + yes.substr(2);
  const auto add = [&](const std::string& option, const std::string& text,
                       const std::string& help) {
    return command
        .add_flag_callback(
            option,
            [name = setting.name, text, &arguments] {
              arguments.overrides.push_back({name, text});
            },
            help)
        ->group(setting.group);
  };
  add(yes, "yes", help_of(setting))->excludes(add(no, "no", "Not " + yes));
}

void add_value(CLI::App& command, const Setting& setting, SettingsArguments& arguments) {
  const std::string name = setting.name;
  command
      .add_option_function<std::string>(
          option_of(setting),
          [name, &arguments](const std::string& text) {
            arguments.overrides.push_back({name, text});
          },
          help_of(setting))
      ->type_name(forms_of(setting))
      ->group(setting.group);
}

/// Errors name the option as it was written.
void apply_override(Settings& settings, const SettingsArguments::Override& override) {
  const Setting& setting = find_setting(override.name);
  parsed(option_of(setting), [&] {
    const SettingValue value = parse_value(setting, override.text);
    check_value(setting, value);
    setting.set(settings, value);
  });
}

}  // namespace

void add_settings_options(CLI::App& command, SettingsArguments& arguments) {
  command.add_option("--preset", arguments.preset, "Settings to start from (default: default)")
      ->check(CLI::IsMember(preset_names()));
  command.add_option("--settings", arguments.file, "Settings or a report: .json");
  for (const Setting& setting : setting_table()) {
    if (is_switch(setting)) {
      add_switch(command, setting, arguments);
    } else {
      add_value(command, setting, arguments);
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
