// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "mesamis/method/parameters.h"
#include "mesamis/method/settings.h"

/// The one table of settings. The command line, JSON files, the checks, the reports and
/// docs/settings.md are made from it.
namespace mesamis::detail::method {

/// A value as text and files hold it: a switch, a word ("auto", "solid"), or numbers.
using SettingValue = std::variant<bool, std::string, std::vector<double>>;

/// One row: a member of Settings and everything that is said about it.
struct Setting {
  std::string name = {};                ///< in JSON, "max_tets"; the option is --max-tets
  std::string group = {};               ///< Image, Functional, Mesh or Surface
  std::string form = {};                ///< what a value looks like: "N", "LO,HI", "solid|band"
  std::size_t count = 0;                ///< numbers in a value; 0: a switch or a word
  bool whole = false;                   ///< the numbers are integers
  bool ranges = false;                  ///< the numbers come in pairs, begin and end
  double low = 0, high = 0;             ///< range of each number, ends included
  std::vector<double> exceptions = {};  ///< further numbers that are accepted
  std::vector<std::string> words = {};  ///< accepted words, "auto" included
  std::string unit = {};                ///< empty: none
  std::string help = {};                ///< one sentence without a full stop
  std::string automatic = {};           ///< how "auto" is found; empty: the setting has no "auto"
  std::string paper = {};               ///< the value in the preset "paper"; empty: the default
  std::function<SettingValue(const Settings&)> get = {};
  /// The value must have passed check_value().
  std::function<void(Settings&, const SettingValue&)> set = {};
  /// Takes over what the settings give; what they leave open stays as the run chose it.
  std::function<void(const Settings&, Parameters&)> use = {};
  /// The value that repeats a run.
  std::function<void(const Parameters&, Settings&)> repeat = {};
};

/// Every setting, in the order in which they are written. O(1): the table is built once.
const std::vector<Setting>& setting_table();

/// Finds the row of this name, with hyphens or underscores.
/// @return a row of setting_table(), which lives as long as the program.
/// @throws InputError  if there is none.
const Setting& find_setting(std::string_view name);

/// What a value may look like: "N|auto".
std::string forms_of(const Setting& setting);

/// Reads a value from text: "3", "1e6", "1,1,2", "0:10,,", "auto", "yes".
///
/// One number stands for all where three are asked for. An empty part of a range is the volume's
/// own bound.
/// @throws InputError  "expected FORM, found TEXT", without the setting's name.
SettingValue parse_value(const Setting& setting, std::string_view text);

/// Writes a value as the shortest text that parse_value() reads back.
std::string text_of(const Setting& setting, const SettingValue& value);

/// Checks a value against its row.
/// @throws InputError  "expected ..., found ...", without the setting's name, for a value of the
///                     wrong kind, a number out of range or a fraction where an integer belongs.
void check_value(const Setting& setting, const SettingValue& value);

/// Checks the value and sets it.
/// @throws InputError  as check_value(), after the setting's name.
void set_setting(Settings& settings, const Setting& setting, const SettingValue& value);

/// Checks all settings.
/// @throws InputError  for the first value out of range: setting, range and value found.
void require_valid(const Settings& settings);

/// Where a run's value came from.
enum class Origin {
  kDefault,  ///< the table's default
  kGiven,    ///< the user, or a preset
  kMeasured  ///< "auto": chosen from the volume and the other settings
};
/// Tells where a setting's value came from. A value equal to the default counts as the default,
/// whoever wrote it.
/// @param setting  a row of setting_table().
Origin origin_of(const Setting& setting, const Settings& asked);

/// The settings of a preset: "default" (ours), or "paper" (the method as the paper prints it).
/// @throws InputError  for another name; the message lists those there are.
Settings preset_settings(std::string_view name);

/// The names of the presets. O(1) time and memory.
std::vector<std::string> preset_names();

/// Writes the table as a page of Markdown: docs/settings.md.
std::string settings_page();

}  // namespace mesamis::detail::method
