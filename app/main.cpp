// SPDX-License-Identifier: Apache-2.0
// The program mesamis: runs the command that the command line names, turns every failure into one
// line on stderr and an exit status.
#include <signal.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <cstring>
#include <exception>
#include <new>
#include <string>
#include <system_error>

#include "command_line.h"
#include "commands.h"
#include "interrupt.h"
#include "join_team.h"
#include "log.h"
#include "mesamis/base/error.h"
#include "mesamis/base/parallel.h"
#include "mesamis/files/atomic_file.h"
#include "run_action.h"
#include "streams.h"

namespace mesamis {
namespace {

/// Of several processes one says why they end.
bool is_alone = true;

/// Leaves nothing half-written, then dies of the signal, as a shell expects.
void end_by_signal(int number) {
  remove_unfinished_files();
  constexpr char kMessage[] = "\nmesamis: interrupted\n";
  if (is_alone) {
    [[maybe_unused]] const auto written = write(STDERR_FILENO, kMessage, sizeof kMessage - 1);
  }
  signal(number, SIG_DFL);
  raise(number);
}

extern "C" void on_signal(int number) {
  if (!note_interrupt(number)) end_by_signal(number);
}

void handle_signals() {
  for (const int number : {SIGINT, SIGTERM, SIGHUP}) {
    if (signal(number, on_signal) == SIG_IGN) signal(number, SIG_IGN);  // nohup
  }
}

/// Writes one line without taking memory.
void tell(const char* line) {
  [[maybe_unused]] const auto written = write(STDERR_FILENO, line, std::strlen(line));
}

[[noreturn]] void end_without_memory() {
  constexpr const char* kText = "mesamis: not enough memory\n";
  constexpr const char* kJson = "{\"level\":\"error\",\"message\":\"not enough memory\"}\n";
  tell(log_is_json() ? kJson : kText);
  _exit(kExitInput);
}

/// An exception that nobody catches: thrown where none may be, in our libraries as well, which is
/// how most of them meet the end of memory.
[[noreturn]] void on_terminate() noexcept {
  remove_unfinished_files();
  try {
    if (const auto error = std::current_exception()) std::rethrow_exception(error);
  } catch (const std::bad_alloc&) {
    end_without_memory();
  } catch (...) {  // a bug: ends as one
  }
  tell("mesamis: internal error: unexpected exception\n");
  _exit(kExitInternal);
}

int run_program(int count, char** arguments, Team& team) {
  CLI::App app("Anisotropic segmentation of 3D scans: printable surfaces and adapted meshes");
  CommonOptions common;
  common.team = &team;
  is_alone = team.size() == 1;
  common.arguments.assign(arguments + 1, arguments + std::max(count, 1));
  Action action;
  add_commands(app, common, action);
  try {
    app.parse(count, arguments);
  } catch (const CLI::Success& request) {  // --help, --version
    set_up_log(common);
    return app.exit(request);
  } catch (const CLI::ParseError& error) {
    set_up_log(common);
    log_error(usage_message(app, error, count, arguments));
    return kExitUsage;
  }
  set_up_log(common);
  const int status = with_threads(common.threads, [&] { return run_action(action); });
  if (const int number = noted_interrupt()) end_by_signal(number);
  return status;
}

/// A result that did not reach its reader is none.
int with_stdout_written(int status) {
  const int error = flush_stdout();
  if (error == 0 || status != kExitDone) return status;
  log_error("stdout: cannot be written: " + std::generic_category().message(error));
  return kExitInput;
}

}  // namespace
}  // namespace mesamis

int main(int count, char** arguments) {
  std::set_terminate(mesamis::on_terminate);
  mesamis::open_closed_streams();
  mesamis::lift_limits();
  mesamis::handle_signals();
  const auto team = mesamis::join_team(count, arguments);
  const int status = mesamis::run_program(count, arguments, *team);
  return mesamis::leave_team(*team, mesamis::with_stdout_written(status));
}
