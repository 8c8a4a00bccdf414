// SPDX-License-Identifier: Apache-2.0
// mesamis settings: what every setting means, its default, range and presets.
#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "commands.h"
#include "mesamis/method/setting_table.h"
#include "mesamis/report/settings_json.h"

namespace mesamis {
namespace {

int print_settings(const std::string& preset, bool markdown) {
  std::cout << (markdown ? settings_page() : to_json(preset_settings(preset)).dump(2) + "\n");
  return kExitDone;
}

}  // namespace

void add_settings_command(CLI::App& app, CommonOptions&, Action& action) {
  struct Options {
    std::string preset = "default";
    bool markdown = false;
  };
  auto options = std::make_shared<Options>();
  CLI::App* command =
      app.add_subcommand("settings", "Print the settings of a preset, as --settings reads them");
  command->add_option("--preset", options->preset, "default or paper")
      ->check(CLI::IsMember(preset_names()));
  command->add_flag("--markdown", options->markdown,
                    "The whole table with units, ranges and meanings, as a page");
  command->callback([options, &action] {
    action = [options] { return print_settings(options->preset, options->markdown); };
  });
}

}  // namespace mesamis
