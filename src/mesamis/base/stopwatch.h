// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>

namespace mesamis {

/// Wall time, from when it is made or last asked.
class Stopwatch {
 public:
  /// Seconds since the last lap.
  double lap() {
    const auto now = std::chrono::steady_clock::now();
    const double seconds = std::chrono::duration<double>(now - start_).count();
    start_ = now;
    return seconds;
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace mesamis
