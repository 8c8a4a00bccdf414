// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "commands.h"

/// Messages of the program on stderr, one line of at most 500 characters each; of a longer one the
/// beginning and the end.
namespace mesamis {

/// Call once, before anything is logged. With --quiet only errors appear.
void set_up_log(const CommonOptions& options);

void log_info(const std::string& message);
void log_warning(const std::string& message);
void log_error(const std::string& message);

/// The warnings that were logged, with --quiet too, since forget_warnings(); as they were given.
const std::vector<std::string>& warnings_logged();
void forget_warnings();

/// What is written of a message: one line, within that bound with what stands before it.
std::string line_of(const std::string& message);

/// Whether the lines are for programs (--log-json).
bool log_is_json();

/// Whether notes and progress go to stdout, for 3D Slicer. Warnings and errors go to stderr, all of
/// which Slicer shows as errors.
bool log_is_for_slicer();

/// How far a run has come.
struct StageProgress {
  std::string stage;
  double fraction = 0;                 ///< of the stage, 0 to 1
  std::optional<double> done;          ///< of the whole, 0 to 1; none: not known
  std::optional<double> seconds_left;  ///< of the whole, or of the stage where it is not known
};

/// For programs: a line of its own, level "progress".
void log_progress(const StageProgress& progress);

/// Whether a progress bar may be drawn: stderr is a terminal and its lines are for people.
bool log_allows_bar();

/// Wipes a progress bar off the current line of the terminal.
inline constexpr const char* kWipeLine = "\r\033[K";

}  // namespace mesamis
