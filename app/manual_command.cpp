// SPDX-License-Identifier: Apache-2.0
// mesamis manual: manual pages and completion for shells, from the parser of the command line.
#include <CLI/CLI.hpp>
#include <filesystem>
#include <iostream>
#include <memory>
#include <regex>

#include "commands.h"
#include "man_page.h"
#include "mesamis/base/error.h"
#include "mesamis/files/atomic_file.h"
#include "mesamis/files/output_set.h"
#include "outputs.h"
#include "shell_completion.h"

namespace mesamis {
namespace {

namespace fs = std::filesystem;

struct ManualOptions {
  fs::path man, bash, zsh;  ///< empty: not asked for
  std::string date;         ///< of the pages
};

void write_pages(const CLI::App& program, const ManualOptions& options, OutputSet& outputs) {
  if (!fs::is_directory(options.man)) {
    throw InputError(options.man.string() + ": expected a folder that exists, found none");
  }
  for (const ManPage& page : man_pages(program, options.date)) {
    write_file(outputs.file(options.man / page.name), page.text);
  }
}

int write_manual(const CLI::App& program, const ManualOptions& options) {
  if (options.man.empty() && options.bash.empty() && options.zsh.empty()) {
    throw CLI::ValidationError("expected --man, --bash or --zsh, found none");
  }
  require_distinct_files({options.bash, options.zsh}, {});
  OutputSet outputs;
  if (!options.man.empty()) write_pages(program, options, outputs);
  if (!options.bash.empty()) write_file(outputs.file(options.bash), bash_completion(program));
  if (!options.zsh.empty()) write_file(outputs.file(options.zsh), zsh_completion(program));
  commit(outputs);
  return kExitDone;
}

std::string check_date(const std::string& text) {
  static const std::regex date(R"(\d{4}-\d{2}-\d{2})");
  return std::regex_match(text, date) ? "" : "expected YYYY-MM-DD, found '" + text + "'";
}

}  // namespace

void add_manual_command(CLI::App& app, CommonOptions&, Action& action) {
  auto options = std::make_shared<ManualOptions>();
  CLI::App* command =
      app.add_subcommand("manual", "Write the manual pages, or completion for bash or zsh");
  command->add_option("--man", options->man, "Folder for a page of each command: .1");
  command->add_option("--bash", options->bash, "Completion for bash, to be sourced");
  command->add_option("--zsh", options->zsh, "Completion for zsh: _mesamis in a folder of fpath");
  command->add_option("--date", options->date, "YYYY-MM-DD: at the foot of the pages")
      ->type_name("YYYY-MM-DD")
      ->check(CLI::Validator(check_date, ""));
  command->callback([options, &app, &action] {
    action = [options, &app] { return write_manual(app, *options); };
  });
}

}  // namespace mesamis
