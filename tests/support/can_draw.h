// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <sstream>
#include <string>

namespace mesamis {

/// Whether pictures can be drawn here: a display is named, or Xvfb is installed.
inline bool can_draw() {
  if (std::getenv("DISPLAY") != nullptr) return true;
  std::stringstream path(std::getenv("PATH") == nullptr ? "" : std::getenv("PATH"));
  for (std::string folder; std::getline(path, folder, ':');) {
    if (std::filesystem::exists(std::filesystem::path(folder) / "Xvfb")) return true;
  }
  return false;
}

}  // namespace mesamis

/// Ends the test as skipped, plainly, where nothing can be drawn.
#define MESAMIS_REQUIRE_DISPLAY()                        \
  if (!mesamis::can_draw()) {                            \
    GTEST_SKIP() << "no display and no Xvfb to draw on"; \
  }                                                      \
  static_assert(true)
