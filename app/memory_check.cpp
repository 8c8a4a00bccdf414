// SPDX-License-Identifier: Apache-2.0
#include "memory_check.h"

#include <fmt/format.h>

#include <fstream>
#include <string>

#include "mesamis/base/error.h"
#include "mesamis/memory.h"

namespace mesamis {
namespace {

/// The number that a file starts with, if it does.
std::optional<double> number_in(const char* path) {
  std::ifstream file(path);
  double value = 0;
  if (file >> value) return value;
  return std::nullopt;
}

}  // namespace

std::optional<double> available_memory() {
  constexpr double kUnit = 1024;
  std::optional<double> available;
  std::ifstream file("/proc/meminfo");
  for (std::string name; file >> name;) {
    double value = 0;
    if (name == "MemAvailable:" && file >> value) available = kUnit * value;
  }
  const auto most = number_in("/sys/fs/cgroup/memory.max");
  const auto used = number_in("/sys/fs/cgroup/memory.current");
  if (available && most && used) available = std::min(*available, *most - *used);
  return available;
}

void require_memory(const Volume& volume, const Settings& settings, double limit_gb) {
  constexpr double kGigabyte = 1e9;
  const auto limit = limit_gb > 0 ? std::optional(limit_gb * kGigabyte) : available_memory();
  const double needed = memory_needed(volume, settings);
  if (!limit || needed <= *limit) return;
  std::string message =
      fmt::format("memory: expected about {:.1f} GB for this run, found {:.1f} GB; ",
                  needed / kGigabyte, *limit / kGigabyte);
  if (const auto stride = stride_that_fits(volume, settings, *limit)) {
    message += fmt::format("--stride {},{},{} fits", (*stride)[0], (*stride)[1], (*stride)[2]);
  } else {
    message += "no stride fits: --crop the scan, or fewer cells (--max-tets)";
  }
  throw InputError(message);
}

}  // namespace mesamis
