// SPDX-License-Identifier: Apache-2.0
#include "mesamis/base/available_memory.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "support/temp_folder.h"

namespace mesamis {
namespace {

/// A machine with 8 MiB free.
void write_machine(const TempFolder& root, const std::string& groups) {
  write_bytes(root / "proc/meminfo", "MemTotal:  16384 kB\nMemAvailable:  8192 kB\n");
  write_bytes(root / "proc/self/cgroup", groups);
}

TEST(AvailableMemory, IsKnownWhereTheSystemTellsAndIsNoMoreThanTheMachineHas) {
  const auto available = available_memory();
  ASSERT_EQ(available.has_value(), std::filesystem::exists("/proc/meminfo"));
  if (!available) GTEST_SKIP() << "this system has no /proc/meminfo";
  EXPECT_GT(*available, 1e6);
  EXPECT_LT(*available, 1e15);
}

TEST(AvailableMemory, IsWhatTheMachineCountsAsFreeWithoutAControlGroup) {
  const TempFolder root;
  write_machine(root, "0::/\n");
  EXPECT_EQ(available_memory(root.path()), 8192.0 * 1024);
  EXPECT_FALSE(available_memory(root / "nothing").has_value());
}

TEST(AvailableMemory, IsWithinTheLimitOfAGroupOfVersion2AndOfThoseAboveIt) {
  const TempFolder root;
  write_machine(root, "0::/outer/inner\n");
  write_bytes(root / "sys/fs/cgroup/outer/inner/memory.max", "max\n");
  write_bytes(root / "sys/fs/cgroup/outer/inner/memory.current", "1000\n");
  EXPECT_EQ(available_memory(root.path()), 8192.0 * 1024);
  write_bytes(root / "sys/fs/cgroup/outer/memory.max", "5000\n");
  write_bytes(root / "sys/fs/cgroup/outer/memory.current", "3000\n");
  write_bytes(root / "sys/fs/cgroup/outer/memory.stat", "file 900\ninactive_file 500\n");
  EXPECT_EQ(available_memory(root.path()), 2500.0);
}

TEST(AvailableMemory, IsWithinTheLimitOfAGroupOfVersion1) {
  const TempFolder root;
  write_machine(root, "12:cpu,cpuacct:/a\n5:memory:/a/b\n0::/\n");
  const std::filesystem::path top = root / "sys/fs/cgroup/memory";
  write_bytes(top / "memory.limit_in_bytes", "9223372036854771712\n");  // none
  write_bytes(top / "memory.usage_in_bytes", "100\n");
  EXPECT_EQ(available_memory(root.path()), 8192.0 * 1024);
  write_bytes(top / "a/b/memory.limit_in_bytes", "7000\n");
  write_bytes(top / "a/b/memory.usage_in_bytes", "3000\n");
  write_bytes(top / "a/b/memory.stat", "inactive_file 1\ntotal_inactive_file 250\n");
  EXPECT_EQ(available_memory(root.path()), 4250.0);
}

/// A container of version 1 is told the machine's path, but sees its own group at the top.
TEST(AvailableMemory, IsWithinTheLimitAtTheTopWhereThePathOfTheGroupIsNotThere) {
  const TempFolder root;
  write_machine(root, "5:memory:/docker/0123\n");
  write_bytes(root / "sys/fs/cgroup/memory/memory.limit_in_bytes", "7000\n");
  write_bytes(root / "sys/fs/cgroup/memory/memory.usage_in_bytes", "8000\n");
  EXPECT_EQ(available_memory(root.path()), 0.0);
}

TEST(MemoryLimit, IsTheCallersOrWhatIsFree) {
  EXPECT_EQ(memory_limit(2.5), 2.5e9);
  EXPECT_EQ(memory_limit(0).has_value(), available_memory().has_value());
}

}  // namespace
}  // namespace mesamis
