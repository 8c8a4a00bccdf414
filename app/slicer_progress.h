// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <string>
#include <string_view>

/// What 3D Slicer reads on the stdout of a module, docs/slicer.md: marks of progress, and lines
/// that it shows as the module's output.
namespace mesamis {

/// Writes a line to stdout at once.
void tell_slicer(const std::string& line);

/// Tells Slicer that everything is done.
void tell_slicer_done();

/// Tells Slicer how far long work has come: each stage begins and ends as a filter, with its name,
/// its seconds, its own progress and that of the whole.
class SlicerProgress {
 public:
  /// @param fraction  of the stage, 0 to 1. Told at once where the stage is new, else at most every
  ///                  tenth of a second.
  /// @param done      of the whole, 0 to 1.
  void show(std::string_view stage, double fraction, double done);
  /// Ends the stage, if there is one.
  void finish();

 private:
  using Clock = std::chrono::steady_clock;
  void enter(std::string_view stage);
  void tell(double fraction, double done);

  std::string stage_;
  double told_ = 0;  ///< of the stage
  Clock::time_point start_, last_told_;
};

}  // namespace mesamis
