// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "mesamis/base/progress.h"
#include "mesamis/run/run_share.h"
#include "slicer_progress.h"

namespace mesamis {

/// Shows the progress of long work on stderr. Where the stages of the work are known, percentage
/// and time left are those of the whole, else those of the stage. On a terminal: one line with the
/// stage, a bar, the percentage and the time left. With --log-json: a line of JSON at the beginning
/// of each stage, then at most one in half a second. Otherwise: a log line for each stage, at most
/// one in two seconds; a shorter stage may have none. For 3D Slicer: see SlicerProgress.
class ProgressDisplay {
 public:
  /// @param stages  of the whole, see stage_shares(); empty: not known.
  explicit ProgressDisplay(bool quiet, std::vector<StageShare> stages = {});
  ~ProgressDisplay() { finish(); }
  ProgressDisplay(const ProgressDisplay&) = delete;
  ProgressDisplay& operator=(const ProgressDisplay&) = delete;

  /// The progress function for the work; refers to this object.
  Progress callback();
  /// Tells that a stage begins which the work itself does not tell. It has no log line: input that is
  /// refused in it leaves one line alone.
  void begin(std::string_view stage);
  /// Wipes the bar.
  void finish();

 private:
  using Clock = std::chrono::steady_clock;
  void show(std::string_view stage, double fraction);
  void enter(std::string_view stage, double fraction);
  std::optional<double> seconds_left() const;
  void log_stage(Clock::time_point now);
  void log_json(Clock::time_point now, double fraction);
  void draw_bar();

  bool quiet_;
  RunShare run_;
  SlicerProgress slicer_;
  bool drawn_ = false;
  bool logged_ = false;  // the stage has been logged
  std::string stage_;
  double fraction_in_stage_ = 0;
  double done_ = 0;           // of the whole, or of the stage
  double done_at_start_ = 0;  // at start_, from when on time is counted
  Clock::time_point start_, last_drawn_, last_line_;
};

}  // namespace mesamis
