// SPDX-License-Identifier: Apache-2.0
#include "memory_check.h"

#include <fmt/format.h>

#include <algorithm>
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

/// The number behind a word of a file, if it is there.
std::optional<double> number_after(const std::string& word, const char* path) {
  std::ifstream file(path);
  for (std::string found; file >> found;) {
    double value = 0;
    if (found == word && file >> value) return value;
  }
  return std::nullopt;
}

}  // namespace

std::optional<double> available_memory() {
  constexpr double kUnit = 1024;
  auto available = number_after("MemAvailable:", "/proc/meminfo");
  if (available) *available *= kUnit;
  const auto most = number_in("/sys/fs/cgroup/memory.max");
  const auto used = number_in("/sys/fs/cgroup/memory.current");
  if (available && most && used) {
    // Files that were read stay in memory until it is wanted.
    const auto cached = number_after("inactive_file", "/sys/fs/cgroup/memory.stat");
    available = std::min(*available, *most - *used + cached.value_or(0));
  }
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
