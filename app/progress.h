// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <string>
#include <string_view>

#include "mesamis/base/progress.h"

namespace mesamis {

/// Shows on stderr how far long work has come. On a terminal: one line with the stage, a bar, the
/// percentage and the time left in this stage. Otherwise: a log line for each stage, at most one in
/// two seconds; stages shorter than that may go without.
class ProgressDisplay {
 public:
  explicit ProgressDisplay(bool quiet) : quiet_(quiet) {}
  ~ProgressDisplay() { finish(); }
  ProgressDisplay(const ProgressDisplay&) = delete;
  ProgressDisplay& operator=(const ProgressDisplay&) = delete;

  /// To be handed to the work; refers to this object.
  Progress callback();
  /// Wipes the bar.
  void finish();

 private:
  using Clock = std::chrono::steady_clock;
  void show(std::string_view stage, double fraction);
  void enter(std::string_view stage, double fraction);
  void tell_stage(Clock::time_point now);
  void draw_bar(double fraction);

  bool quiet_;
  bool drawn_ = false;
  bool told_ = false;  // the stage has had its line
  std::string stage_;
  double fraction_at_start_ = 0;
  Clock::time_point stage_start_, last_drawn_, last_line_;
};

}  // namespace mesamis
