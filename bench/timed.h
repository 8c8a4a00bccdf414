// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/resource.h>

#include <chrono>
#include <cstdio>
#include <ctime>

namespace mesamis {

/// Runs the work once and prints its time, that of all processors together, and the most memory
/// until now.
template <class Work>
auto timed(const char* what, Work work) {
  const auto start = std::chrono::steady_clock::now();
  const std::clock_t ticks = std::clock();
  auto result = work();
  const std::chrono::duration<double> time = std::chrono::steady_clock::now() - start;
  const double processors = static_cast<double>(std::clock() - ticks) / CLOCKS_PER_SEC;
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  std::printf("%-42s %7.2f s  %7.2f s of processors  %6.2f GB\n", what, time.count(), processors,
              static_cast<double>(usage.ru_maxrss) / (1 << 20));
  return result;
}

}  // namespace mesamis
