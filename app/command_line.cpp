// SPDX-License-Identifier: Apache-2.0
#include "command_line.h"

#include <CLI/CLI.hpp>

#include "arguments.h"
#include "mesamis/base/version.h"

namespace mesamis {
namespace {

std::string version_text() {
  return std::string("mesamis ") + version() + " (commit " + commit() + ")";
}

}  // namespace

void add_common_options(CLI::App& app, CommonOptions& common) {
  app.set_version_flag("--version", version_text());
  app.require_subcommand(1);
  app.fallthrough();
  app.add_flag("--quiet", common.quiet, "Nothing on stderr but errors");
  app.add_flag("--log-json", common.log_json, "Log and progress on stderr as JSON, a line each");
  app.add_option("--threads", common.threads, "Threads at most (default: all)")
      ->check(CLI::Range(1, 1024));
  app.add_option("--memory", common.limits.memory_gb,
                 "Memory that a run or a file that is read may take, GB (default: what is free)")
      ->check(CLI::PositiveNumber);
  app.add_flag("--allow-outside", common.limits.allow_outside,
               "Let .nhdr and .mhd name data files outside of their folder");
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
  if (chosen.empty() && count > 1 && arguments[1][0] != '-') {
    return "no command '" + std::string(arguments[1]) + "' (mesamis --help lists them)";
  }
  if (chosen.empty() && error.get_exit_code() == static_cast<int>(CLI::ExitCodes::ExtrasError)) {
    return one_line(error.what()) + " (mesamis --help lists what there is)";
  }
  if (chosen.empty()) return "a command is required (mesamis --help lists them)";
  return one_line(error.what()) + " (mesamis " + chosen[0]->get_name() + " --help tells more)";
}

}  // namespace mesamis
