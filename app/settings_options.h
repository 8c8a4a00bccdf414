// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "mesamis/method/setting_table.h"
#include "mesamis/method/settings.h"
#include "mesamis/shape_files/surface_files.h"

namespace CLI {
class App;
}  // namespace CLI

/// The options of every command that runs the method, made from setting_table().
namespace mesamis {

/// The settings of a run on the command line.
struct SettingsArguments {
  struct Override {
    std::string name, text;  ///< of a setting, and its value
    std::string option;      ///< as it is written
  };
  std::string preset = "default";
  std::filesystem::path file;       ///< of settings, or a report; may be empty
  std::vector<Override> overrides;  ///< options, on top of the file's
};

/// Adds --preset, --settings and one option for each of the settings. `arguments` must outlive the
/// parsing.
/// @param mark  between the words of an option: --max-tets, or '_' as in setting_table().
void add_settings_options(CLI::App& command, SettingsArguments& arguments, char mark = '-');

/// The option of a switch that turns its setting off: "--no-restore".
std::string option_against(const Setting& setting, char mark);

/// Whether the setting is on or off.
bool is_switch(const Setting& setting);

/// What an option of a setting says of it: "Smallest edge (length units; default 0.25)".
std::string help_of(const Setting& setting);

/// The settings of the preset, overridden by those of the file, then by those of the options.
/// @throws InputError            if the file cannot be read or has a setting that is refused.
/// @throws CLI::ValidationError  if an option's value is refused.
Settings settings_of(const SettingsArguments& arguments);

/// Adds --frame, the frame of the files written. `frame` must outlive the parsing.
void add_frame_option(CLI::App& command, Frame& frame);

/// "I0:I1,J0:J1,K0:K1" as a range of voxels; an empty bound is the volume's own.
/// @throws CLI::ValidationError  naming the option, if the text is something else.
CropRange parse_crop(const std::string& text, const std::string& option);

}  // namespace mesamis
