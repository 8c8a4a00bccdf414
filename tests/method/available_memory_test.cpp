// SPDX-License-Identifier: Apache-2.0
#include "mesamis/method/available_memory.h"

#include <gtest/gtest.h>

#include <filesystem>

namespace mesamis {
namespace {

TEST(AvailableMemory, IsKnownWhereTheSystemTellsAndIsNoMoreThanTheMachineHas) {
  const auto available = available_memory();
  ASSERT_EQ(available.has_value(), std::filesystem::exists("/proc/meminfo"));
  if (!available) GTEST_SKIP() << "this system has no /proc/meminfo";
  EXPECT_GT(*available, 1e6);
  EXPECT_LT(*available, 1e15);
}

}  // namespace
}  // namespace mesamis
