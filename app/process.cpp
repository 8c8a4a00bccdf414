// SPDX-License-Identifier: Apache-2.0
#include "process.h"

#include <sys/resource.h>

#include <chrono>

namespace mesamis {
namespace {

auto start = std::chrono::steady_clock::now();

}  // namespace

double peak_memory_mb() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
#ifdef __APPLE__
  constexpr double kUnit = 1;  // bytes
#else
  constexpr double kUnit = 1024;
#endif
  return kUnit * static_cast<double>(usage.ru_maxrss) / 1e6;
}

double wall_seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

void restart_clock() { start = std::chrono::steady_clock::now(); }

}  // namespace mesamis
