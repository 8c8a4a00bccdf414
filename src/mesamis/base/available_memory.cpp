// SPDX-License-Identifier: Apache-2.0
#include "mesamis/base/available_memory.h"

#include <algorithm>
#include <fstream>
#include <limits>
#include <string>

namespace mesamis::detail::base {
namespace {

namespace fs = std::filesystem;

/// The files of a control group that tell about memory, by version.
struct GroupFiles {
  const char* limit;
  const char* used;
  const char* cached;  ///< in memory.stat: files that were read stay in memory until it is wanted
};
constexpr GroupFiles kVersion1{"memory.limit_in_bytes", "memory.usage_in_bytes",
                               "total_inactive_file"};
constexpr GroupFiles kVersion2{"memory.max", "memory.current", "inactive_file"};

/// The number that a file starts with, if it does.
std::optional<double> number_in(const fs::path& path) {
  std::ifstream file(path);
  double value = 0;
  if (file >> value) return value;
  return std::nullopt;
}

/// The number behind a word of a file, if it is there.
std::optional<double> number_after(const std::string& word, const fs::path& path) {
  std::ifstream file(path);
  for (std::string found; file >> found;) {
    double value = 0;
    if (found == word && file >> value) return value;
  }
  return std::nullopt;
}

/// What a control group can still take; infinity where it has no limit.
double left_in_group(const fs::path& folder, const GroupFiles& files) {
  const auto most = number_in(folder / files.limit);
  const auto used = number_in(folder / files.used);
  if (!most || !used) return std::numeric_limits<double>::infinity();
  return *most - *used + number_after(files.cached, folder / "memory.stat").value_or(0);
}

/// The least of a group and those above it. In a container the path may be that of the machine,
/// which is not there: then only the group at the top counts.
double left_in_groups(const fs::path& top, fs::path group, const GroupFiles& files) {
  double left = left_in_group(top, files);
  for (group = group.relative_path(); !group.empty(); group = group.parent_path()) {
    left = std::min(left, left_in_group(top / group, files));
  }
  return left;
}

/// A line of proc/self/cgroup is "number:controllers:path"; version 2 has no controllers.
double left_for_process(const fs::path& root) {
  const fs::path top = root / "sys/fs/cgroup";
  double left = std::min(left_in_group(top, kVersion2), left_in_group(top / "memory", kVersion1));
  std::ifstream groups(root / "proc/self/cgroup");
  for (std::string line; std::getline(groups, line);) {
    const std::size_t first = line.find(':'), second = line.find(':', first + 1);
    if (first == line.npos || second == line.npos) continue;
    const std::string controllers = "," + line.substr(first + 1, second - first - 1) + ",";
    const fs::path group = line.substr(second + 1);
    if (controllers == ",,") left = std::min(left, left_in_groups(top, group, kVersion2));
    if (controllers.find(",memory,") != controllers.npos) {
      left = std::min(left, left_in_groups(top / "memory", group, kVersion1));
    }
  }
  return left;
}

}  // namespace

std::optional<double> available_memory(const fs::path& root) {
  constexpr double kUnit = 1024;
  const auto free = number_after("MemAvailable:", root / "proc/meminfo");
  if (!free) return std::nullopt;
  return std::max(0.0, std::min(kUnit * *free, left_for_process(root)));
}

std::optional<double> memory_limit(double limit_gb) {
  constexpr double kGigabyte = 1e9;
  return limit_gb > 0 ? std::optional(kGigabyte * limit_gb) : available_memory();
}

}  // namespace mesamis::detail::base
