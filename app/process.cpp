// SPDX-License-Identifier: Apache-2.0
#include "process.h"

#include <sys/resource.h>

#include <chrono>

namespace mesamis {
namespace {

const auto kStart = std::chrono::steady_clock::now();

}  // namespace

double peak_memory_mb() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return peak_memory_mb(usage);
}

double peak_memory_mb(const rusage& usage) {
#ifdef __APPLE__
  constexpr double kUnit = 1;  // bytes
#else
  constexpr double kUnit = 1024;
#endif
  return kUnit * static_cast<double>(usage.ru_maxrss) / 1e6;
}

double cpu_seconds(const rusage& usage) {
  auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

double wall_seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - kStart).count();
}

}  // namespace mesamis
