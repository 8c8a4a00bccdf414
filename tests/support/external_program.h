// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <sstream>
#include <string>

namespace mesamis {

/// Whether a program that judges our files is installed.
inline bool is_installed(const std::string& program) {
  std::stringstream path(std::getenv("PATH") == nullptr ? "" : std::getenv("PATH"));
  for (std::string folder; std::getline(path, folder, ':');) {
    if (std::filesystem::exists(std::filesystem::path(folder) / program)) return true;
  }
  return false;
}

/// Runs a command in a folder, its output in `log` there.
/// @return the exit status, 0 for success.
inline int run_in(const std::filesystem::path& folder, const std::string& command) {
  const std::string line = "cd '" + folder.string() + "' && " + command + " > log 2>&1 < /dev/null";
  return std::system(line.c_str());
}

}  // namespace mesamis

/// Ends the test as skipped, plainly, where a program that judges is not installed.
#define MESAMIS_REQUIRE_PROGRAM(program)              \
  if (!mesamis::is_installed(program)) {              \
    GTEST_SKIP() << (program) << " is not installed"; \
  }                                                   \
  static_assert(true)
