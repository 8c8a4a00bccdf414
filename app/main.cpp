// SPDX-License-Identifier: Apache-2.0
// The program mesamis: reads the command line, runs one command, turns every failure into one
// line on stderr and an exit status.
#include <signal.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <cstring>
#include <exception>
#include <filesystem>
#include <new>
#include <string>
#include <string_view>
#include <system_error>

#include "arguments.h"
#include "commands.h"
#include "interrupt.h"
#include "log.h"
#include "mesamis/base/error.h"
#include "mesamis/base/parallel.h"
#include "mesamis/base/version.h"
#include "mesamis/files/atomic_file.h"
#include "streams.h"

namespace mesamis {
namespace {

/// Leaves nothing half-written, then dies of the signal, as a shell expects.
void end_by_signal(int number) {
  remove_unfinished_files();
  constexpr char kMessage[] = "\nmesamis: interrupted\n";
  [[maybe_unused]] const auto written = write(STDERR_FILENO, kMessage, sizeof kMessage - 1);
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

void add_common_options(CLI::App& app, CommonOptions& common) {
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

std::string version_text() {
  return std::string("mesamis ") + version() + " (commit " + commit() + ")";
}

void add_commands(CLI::App& app, CommonOptions& common, Action& action) {
  app.set_version_flag("--version", version_text());
  app.require_subcommand(1);
  app.fallthrough();  // the common options may stand after the command
  add_common_options(app, common);
  add_segment_command(app, common, action);
  add_decimate_command(app, common, action);
  add_remesh_command(app, common, action);
  add_baseline_command(app, common, action);
  add_compare_command(app, common, action);
  add_study_command(app, common, action);
  add_phantom_command(app, common, action);
  add_picture_command(app, common, action);
  add_info_command(app, common, action);
  add_settings_command(app, common, action);
  add_slice_command(app, common, action);
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
  tell("mesamis: internal error: an exception that nobody expects\n");
  _exit(kExitInternal);
}

/// What TBB throws where the system has no thread left; it has no type of its own.
bool is_lack_of_threads(const std::exception& error) {
  return std::string_view(error.what()).starts_with("pthread_create");
}

int run(const Action& action) {
  try {
    return action();
  } catch (const Interrupted&) {
    return kExitDone;  // never seen: the program ends by the signal
  } catch (const CLI::Error& error) {
    log_error(error.what());
    return kExitUsage;
  } catch (const InputError& error) {
    log_error(error.what());
    return kExitInput;
  } catch (const NumericalError& error) {
    log_error(error.what());
    return kExitNotConverged;
  } catch (const std::filesystem::filesystem_error& error) {
    log_error(error.path1().string() + ": " + error.code().message());
    return kExitInput;
  } catch (const std::bad_alloc&) {
    log_error("not enough memory for this input");
    return kExitInput;
  } catch (const std::exception& error) {
    if (is_lack_of_threads(error)) {
      log_error("no thread can be started; --threads 1 needs none");
      return kExitInput;
    }
    log_error(std::string("internal error: ") + error.what());
    return kExitInternal;
  }
}

/// One line for what the parser found wrong, and where to read more.
std::string usage_message(const CLI::App& app, const CLI::ParseError& error, int count,
                          char** arguments) {
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

int run_program(int count, char** arguments) {
  CLI::App app("Anisotropic segmentation of 3D scans: printable surfaces and adapted meshes");
  CommonOptions common;
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
  const int status = with_threads(common.threads, [&] { return run(action); });
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
  return mesamis::with_stdout_written(mesamis::run_program(count, arguments));
}
