// SPDX-License-Identifier: Apache-2.0
#include "command_line.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <vector>

#include "arguments.h"
#include "help_text.h"
#include "mesamis/base/nearest_names.h"
#include "mesamis/base/version.h"
#include "mesamis/base/written_number.h"
#include "option_facts.h"
#include "ranges.h"

namespace mesamis {
namespace {

std::string version_text() {
  return std::string("mesamis ") + version() + " (commit " + commit() + ")";
}

std::vector<std::string> command_names(const CLI::App& program) {
  std::vector<std::string> names;
  for (const CLI::App* command : shown_commands(program)) names.push_back(command->get_name());
  return names;
}

std::vector<std::string> option_names(const std::vector<const CLI::App*>& commands) {
  std::vector<std::string> names;
  for (const CLI::App* command : commands) {
    for (const OptionFacts& option : option_facts(*command)) {
      if (!option.positional) names.insert(names.end(), option.names.begin(), option.names.end());
    }
  }
  return names;
}

/// The first argument that is no option; empty if there is none.
std::string first_word(int count, const char* const* arguments) {
  for (int n = 1; n < count; ++n) {
    if (arguments[n][0] != '-') return arguments[n];
  }
  return {};
}

/// The first argument that looks like an option and is none; empty if there is none.
std::string unknown_option(const std::vector<std::string>& names, int count,
                           const char* const* arguments) {
  for (int n = 1; n < count; ++n) {
    const std::string argument = arguments[n];
    const std::string name = argument.substr(0, argument.find('='));
    const bool known = std::find(names.begin(), names.end(), name) != names.end();
    if (name.starts_with("--") && name.size() > 2 && !known) return name;
  }
  return {};
}

/// The library's words for an option that was repeated, as ours.
std::string with_our_words(std::string message) {
  constexpr std::string_view kTheirs = ": At Most 1 required but received ";
  const std::size_t at = message.find(kTheirs);
  if (at == std::string::npos) return message;
  return message.replace(at, kTheirs.size(), ": expected once, found ") + " times";
}

}  // namespace

void add_common_options(CLI::App& app, CommonOptions& common) {
  app.set_version_flag("--version", version_text());
  set_up_help(app);
  app.option_defaults()->group("Options of every command");
  app.require_subcommand(1);
  app.fallthrough();
  app.add_flag("--quiet", common.quiet, "Write only errors to stderr");
  app.add_flag("--log-json", common.log_json, "Log and progress on stderr as lines of JSON");
  app.add_option("--threads", common.threads, "Number of threads at most (default: all)")
      ->check(from_to(1, 1024));
  app.add_option("--memory", common.limits.memory_gb,
                 "Memory limit of a run and of each file read, GB (default: what is available)")
      ->check(above_zero());
  app.add_flag("--allow-outside", common.limits.allow_outside,
               "Let .nhdr and .mhd name data files outside their folder");
  app.option_defaults()->group("Options");  // commands take it over
}

void add_commands(CLI::App& app, CommonOptions& common, Action& action) {
  add_common_options(app, common);
  add_segment_command(app, common, action);
  add_decimate_command(app, common, action);
  add_remesh_command(app, common, action);
  add_baseline_command(app, common, action);
  add_compare_command(app, common, action);
  add_label_command(app, common, action);
  add_study_command(app, common, action);
  add_phantom_command(app, common, action);
  add_picture_command(app, common, action);
  add_report_command(app, common, action);
  add_info_command(app, common, action);
  add_settings_command(app, common, action);
  add_slice_command(app, common, action);
  add_slicer_segment_command(app, common, action);
  add_bids_command(app, common, action);
  add_manual_command(app, common, action);
}

std::string usage_message(const CLI::App& app, const CLI::ParseError& error, int count,
                          const char* const* arguments) {
  const auto chosen = app.get_subcommands();
  const bool extra = error.get_exit_code() == static_cast<int>(CLI::ExitCodes::ExtrasError);
  if (chosen.empty()) {
    const std::string word = first_word(count, arguments);
    if (!word.empty()) {
      return "no command " + quoted_text(word) + did_you_mean(word, command_names(app)) +
             " (mesamis --help lists them)";
    }
    return (extra ? one_line(error.what()) : "a command is required") +
           " (mesamis --help lists them)";
  }
  const std::string name = chosen[0]->get_name();
  const std::vector<std::string> names = option_names({&app, chosen[0]});
  const std::string unknown = extra ? unknown_option(names, count, arguments) : "";
  if (unknown.empty()) {
    return one_line(with_our_words(error.what())) + " (mesamis " + name + " --help tells more)";
  }
  return "no option " + quoted_text(unknown) + did_you_mean(unknown, names) + " (mesamis " + name +
         " --help-all lists them)";
}

}  // namespace mesamis
