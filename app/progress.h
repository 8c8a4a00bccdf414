// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <string>
#include <string_view>

#include "mesamis/base/progress.h"
#include "slicer_progress.h"

namespace mesamis {

/// Shows the progress of long work on stderr. On a terminal: one line with the stage, a bar, the
/// percentage and the time left in this stage. With --log-json: a line of JSON at the beginning of
/// each stage, then at most one in half a second. Otherwise: a log line for each stage, at most one
/// in two seconds; a shorter stage may have none. For 3D Slicer: see SlicerProgress.
class ProgressDisplay {
 public:
  explicit ProgressDisplay(bool quiet) : quiet_(quiet) {}
  ~ProgressDisplay() { finish(); }
  ProgressDisplay(const ProgressDisplay&) = delete;
  ProgressDisplay& operator=(const ProgressDisplay&) = delete;

  /// The progress function for the work; refers to this object.
  Progress callback();
  /// Wipes the bar.
  void finish();

 private:
  using Clock = std::chrono::steady_clock;
  void show(std::string_view stage, double fraction);
  void enter(std::string_view stage, double fraction);
  void log_stage(Clock::time_point now);
  void log_json(Clock::time_point now, double fraction);
  void draw_bar(double fraction);

  bool quiet_;
  SlicerProgress slicer_;
  bool drawn_ = false;
  bool logged_ = false;  // the stage has been logged
  std::string stage_;
  double fraction_at_start_ = 0;
  Clock::time_point stage_start_, last_drawn_, last_line_;
};

}  // namespace mesamis
