// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

namespace mesamis {

/// A file or folder of the optional test data (CMake: MESAMIS_TEST_DATA).
inline std::filesystem::path test_data(const std::filesystem::path& name) {
  return std::filesystem::path(MESAMIS_TEST_DATA) / name;
}

}  // namespace mesamis

/// Ends the test as skipped, plainly, where an optional data file is not there.
#define MESAMIS_REQUIRE_DATA(path)                              \
  if (!std::filesystem::exists(path)) {                         \
    GTEST_SKIP() << "optional test data not found: " << (path); \
  }                                                             \
  static_assert(true)
