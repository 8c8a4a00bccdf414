// SPDX-License-Identifier: Apache-2.0
#include "mesamis/files/owned_file.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>

#include "support/temp_folder.h"

namespace mesamis {
namespace {

namespace fs = std::filesystem;

TEST(NewName, DiffersAndLiesInTheFolder) {
  EXPECT_NE(new_name("/a"), new_name("/a"));
  EXPECT_EQ(new_name("/a").parent_path(), "/a");
}

TEST(CreateOwned, IsAbandonedOnceTheDescriptorIsClosed) {
  const TempFolder folder;
  const fs::path file = new_name(folder.path());
  const int descriptor = create_owned(file);
  ASSERT_GE(descriptor, 0);
  EXPECT_FALSE(is_abandoned(file));
  close(descriptor);
  EXPECT_TRUE(is_abandoned(file));
  EXPECT_TRUE(is_abandoned(file)) << "asking takes nothing";
}

TEST(CreateOwned, NeverTakesAFileThatIsThere) {
  const TempFolder folder;
  write_bytes(folder / "a", "old");
  EXPECT_EQ(create_owned(folder / "a"), -1);
  EXPECT_EQ(errno, EEXIST);
  EXPECT_EQ(read_bytes(folder / "a"), "old");
}

TEST(IsAbandoned, NoForWhatIsNoFile) {
  const TempFolder folder;
  write_bytes(folder / "a", "x");
  fs::create_symlink("a", folder / "link");
  EXPECT_FALSE(is_abandoned(folder / "link"));
  EXPECT_FALSE(is_abandoned(folder / "missing"));
  EXPECT_FALSE(is_abandoned(folder.path()));
}

TEST(RemoveAbandoned, LeavesOwnedFilesAndOtherNames) {
  const TempFolder folder;
  const fs::path owned = new_name(folder.path()), left = new_name(folder.path());
  const int descriptor = create_owned(owned);
  close(create_owned(left));
  const std::string name = owned.filename().string();
  const std::vector<std::string> others{name + "x", "x" + name, ".mesamis-xyz.unfinished", "a.stl",
                                        ".mesamis-0123456789ABCDEF.unfinished"};
  for (const std::string& other : others) write_bytes(folder / other, "user's");
  remove_abandoned(folder.path());
  EXPECT_TRUE(fs::exists(owned));
  EXPECT_FALSE(fs::exists(left));
  for (const std::string& other : others) EXPECT_TRUE(fs::exists(folder / other)) << other;
  close(descriptor);
}

/// The number of the process says nothing: in a container it is 1 in each run.
TEST(RemoveAbandoned, TellsProcessesByTheirLocks) {
  const TempFolder folder;
  int ready[2];
  ASSERT_EQ(pipe(ready), 0);
  const pid_t child = fork();
  if (child == 0) {
    create_owned(folder / ".mesamis-0123456789abcdef.unfinished");
    [[maybe_unused]] const auto told = write(ready[1], "x", 1);
    pause();
  }
  char byte = 0;
  ASSERT_EQ(read(ready[0], &byte, 1), 1);
  remove_abandoned(folder.path());
  EXPECT_EQ(folder.file_count(), 1);
  kill(child, SIGKILL);
  waitpid(child, nullptr, 0);
  remove_abandoned(folder.path());
  EXPECT_EQ(folder.file_count(), 0);
  close(ready[0]);
  close(ready[1]);
}

TEST(RemoveAbandoned, AFolderThatIsNotThereIsNoFailure) { remove_abandoned("/no/such/folder"); }

}  // namespace
}  // namespace mesamis
