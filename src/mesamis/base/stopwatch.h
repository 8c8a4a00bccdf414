// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>

#include "mesamis/rooms.h"

namespace mesamis::detail::base {

/// Measures wall time, from its construction or the last lap().
class Stopwatch {
 public:
  /// Seconds since the construction or the last call; starts the next lap.
  double lap() noexcept {
    const auto now = std::chrono::steady_clock::now();
    const double seconds = std::chrono::duration<double>(now - start_).count();
    start_ = now;
    return seconds;
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace mesamis::detail::base
