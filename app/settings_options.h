// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "mesamis/io/surface_files.h"
#include "mesamis/settings.h"

/// The options of every command that runs the method.
namespace mesamis {

/// What the command line says about a run's settings.
struct SettingsArguments {
  std::filesystem::path file;                           ///< of settings, or a report; may be empty
  nlohmann::json overrides = nlohmann::json::object();  ///< options, on top of the file's
};

/// Adds --settings and one option for each of the settings. `arguments` must outlive the parsing.
void add_settings_options(CLI::App& command, SettingsArguments& arguments);

/// The settings asked for: the defaults, under the file's, under the options'.
/// @throws InputError            if the file cannot be read or has a setting that is refused.
/// @throws CLI::ValidationError  if an option's value is refused.
Settings settings_of(const SettingsArguments& arguments);

/// Adds --frame, that of the files written. `frame` must outlive the parsing.
void add_frame_option(CLI::App& command, Frame& frame);

/// "I0:I1,J0:J1,K0:K1" as the setting crop is written; an empty bound is the volume's own.
/// @throws CLI::ValidationError  naming the option, if the text is something else.
nlohmann::json crop_ranges(const std::string& text, const std::string& option);

}  // namespace mesamis
