// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "mesamis/files/reading.h"
#include "mesamis/report/verdict.h"
#include "mesamis/slabs/team.h"

namespace CLI {
class App;
}  // namespace CLI

namespace mesamis {

/// The exit statuses of the program.
inline constexpr int kExitDone = 0;
inline constexpr int kExitInternal = 1;      ///< a bug
inline constexpr int kExitUsage = 2;         ///< the command line
inline constexpr int kExitInput = 3;         ///< an input was refused
inline constexpr int kExitNotConverged = 4;  ///< outputs are written and marked in the report
inline constexpr int kExitNotClosed = 5;     ///< a surface that should be closed is not

/// The exit status of a run with this outcome.
constexpr int exit_status(VerdictKind outcome) {
  return outcome == VerdictKind::kKept           ? kExitDone
         : outcome == VerdictKind::kNotConverged ? kExitNotConverged
                                                 : kExitNotClosed;
}

/// Options of every command.
struct CommonOptions {
  bool quiet = false;                    ///< nothing on stderr but errors
  bool log_json = false;                 ///< stderr as JSON lines
  bool for_slicer = false;               ///< notes and progress on stdout, as 3D Slicer reads them
  int threads = 0;                       ///< 0: as many as the machine has
  ReadLimits limits{};                   ///< memory that a run may take too
  std::vector<std::string> arguments{};  ///< the command line, without the program
  Team* team = &alone();                 ///< the processes that run the command together

  /// Whether this process is not the one that speaks and writes.
  bool is_helper() const { return team->rank() > 0; }
};

/// A command with its options, ready to run; returns an exit status. It may throw InputError and
/// NumericalError.
using Action = std::function<int()>;

/// Each function adds a subcommand, which sets the action when the command line names it. `common`
/// and `action` must outlive the parsing.
void add_baseline_command(CLI::App& app, CommonOptions& common, Action& action);
void add_bids_command(CLI::App& app, CommonOptions& common, Action& action);
void add_compare_command(CLI::App& app, CommonOptions& common, Action& action);
void add_decimate_command(CLI::App& app, CommonOptions& common, Action& action);
void add_info_command(CLI::App& app, CommonOptions& common, Action& action);
void add_label_command(CLI::App& app, CommonOptions& common, Action& action);
void add_manual_command(CLI::App& app, CommonOptions& common, Action& action);
void add_phantom_command(CLI::App& app, CommonOptions& common, Action& action);
void add_picture_command(CLI::App& app, CommonOptions& common, Action& action);
void add_remesh_command(CLI::App& app, CommonOptions& common, Action& action);
void add_report_command(CLI::App& app, CommonOptions& common, Action& action);
void add_segment_command(CLI::App& app, CommonOptions& common, Action& action);
void add_settings_command(CLI::App& app, CommonOptions& common, Action& action);
void add_slice_command(CLI::App& app, CommonOptions& common, Action& action);
void add_slicer_segment_command(CLI::App& app, CommonOptions& common, Action& action);
void add_study_command(CLI::App& app, CommonOptions& common, Action& action);

}  // namespace mesamis
