// SPDX-License-Identifier: Apache-2.0
#include "mesamis/method/available_memory.h"

#include <algorithm>
#include <fstream>
#include <string>

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

}  // namespace mesamis
