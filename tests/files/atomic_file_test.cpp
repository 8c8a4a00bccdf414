// SPDX-License-Identifier: Apache-2.0
#include "mesamis/files/atomic_file.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <memory>
#include <vector>

#include "support/temp_folder.h"
#include "support/throws.h"

namespace mesamis {
namespace {

TEST(AtomicFile, AppearsWithCommit) {
  const TempFolder folder;
  AtomicFile file(folder / "a.stl");
  write_bytes(file.temporary_path(), "whole");
  EXPECT_FALSE(std::filesystem::exists(folder / "a.stl"));
  file.commit();
  EXPECT_EQ(read_bytes(folder / "a.stl"), "whole");
  EXPECT_EQ(folder.file_count(), 1u);
}

TEST(AtomicFile, LeavesNothingAndTouchesNothingWithoutCommit) {
  const TempFolder folder;
  write_bytes(folder / "a.stl", "old");
  {
    const AtomicFile file(folder / "a.stl");
    write_bytes(file.temporary_path(), "half");
    EXPECT_EQ(folder.file_count(), 2u);
  }
  EXPECT_EQ(read_bytes(folder / "a.stl"), "old");
  EXPECT_EQ(folder.file_count(), 1u);
}

TEST(AtomicFile, ReplacesAFile) {
  const TempFolder folder;
  write_bytes(folder / "a.stl", "old");
  AtomicFile file(folder / "a.stl");
  write_bytes(file.temporary_path(), "new");
  file.commit();
  EXPECT_EQ(read_bytes(folder / "a.stl"), "new");
}

TEST(AtomicFile, TemporaryLiesBesideUnderANameOfItsOwn) {
  const TempFolder folder;
  const AtomicFile one(folder / "a.b.vtp"), two(folder / "a.b.vtp");
  EXPECT_EQ(one.temporary_path().parent_path(), (folder / "a").parent_path());
  EXPECT_NE(one.temporary_path(), two.temporary_path());
}

TEST(AtomicFile, WorksInTheCurrentDirectory) {
  const TempFolder folder;
  const auto before = std::filesystem::current_path();
  std::filesystem::current_path(folder / "");
  AtomicFile file("plain.obj");
  EXPECT_TRUE(file.temporary_path().is_absolute());
  write_bytes(file.temporary_path(), "x");
  file.commit();
  EXPECT_TRUE(std::filesystem::exists(folder / "plain.obj"));
  std::filesystem::current_path(before);
}

TEST(AtomicFile, RefusesWhereNoFileCanBe) {
  const TempFolder folder;
  using testing::HasSubstr;
  EXPECT_REFUSED(AtomicFile(folder / "missing/a.stl"),
                 HasSubstr("missing/a.stl: cannot be written"));
  EXPECT_REFUSED(AtomicFile("/dev/null"), HasSubstr("expected the name of a file"));
  EXPECT_REFUSED(AtomicFile(folder / ""), HasSubstr("expected the name of a file"));
  EXPECT_REFUSED(AtomicFile(folder / std::string(300, 'x')), HasSubstr("cannot be written"));
  EXPECT_EQ(folder.file_count(), 0u);
}

TEST(AtomicFile, TakesTheLongestNameAndKnowsALongerOneAtOnce) {
  const TempFolder folder;
  AtomicFile file(folder / std::string(255, 'x'));
  file.commit();
  EXPECT_REFUSED(AtomicFile(folder / std::string(256, 'x')), testing::HasSubstr("name too long"));
}

TEST(AtomicFile, KeepsTheModeOfWhatItReplaces) {
  const TempFolder folder;
  write_bytes(folder / "a.stl", "old");
  namespace fs = std::filesystem;
  fs::permissions(folder / "a.stl", fs::perms{0640});
  write_file(folder / "a.stl", "new");
  EXPECT_EQ(fs::status(folder / "a.stl").permissions(), fs::perms{0640});
  EXPECT_EQ(read_bytes(folder / "a.stl"), "new");
}

TEST(AtomicFile, FollowsLinksThereOrNot) {
  const TempFolder folder;
  namespace fs = std::filesystem;
  fs::create_directory(folder / "far");
  fs::create_symlink("far/real.stl", folder / "near.stl");
  fs::create_symlink("near.stl", folder / "a.stl");
  for (const std::string bytes : {"one", "two"}) {  // the file is made, then replaced
    write_file(folder / "a.stl", bytes);
    EXPECT_TRUE(fs::is_symlink(folder / "a.stl"));
    EXPECT_TRUE(fs::is_symlink(folder / "near.stl"));
    EXPECT_EQ(read_bytes(folder / "far/real.stl"), bytes);
  }
}

TEST(AtomicFile, RefusesLinksInACircle) {
  const TempFolder folder;
  std::filesystem::create_symlink("b.stl", folder / "a.stl");
  std::filesystem::create_symlink("a.stl", folder / "b.stl");
  EXPECT_REFUSED(AtomicFile(folder / "a.stl"), testing::HasSubstr("a.stl: cannot be written"));
}

/// Leaves the temporary file of a process that was killed.
void leave_behind(const std::filesystem::path& target) {
  const pid_t child = fork();
  if (child == 0) {
    const AtomicFile file(target);
    kill(getpid(), SIGKILL);
  }
  waitpid(child, nullptr, 0);
}

TEST(AtomicFile, RemovesWhatAKilledProcessLeft) {
  const TempFolder folder;
  leave_behind(folder / "a.stl");
  ASSERT_EQ(folder.file_count(), 1u);
  write_file(folder / "b.vtu", "whole");
  EXPECT_EQ(folder.file_count(), 1u);
  EXPECT_TRUE(std::filesystem::exists(folder / "b.vtu"));
}

TEST(AtomicFile, CommitSaysWhenTheTargetBecameADirectory) {
  const TempFolder folder;
  AtomicFile file(folder / "a.stl");
  std::filesystem::create_directory(folder / "a.stl");
  EXPECT_REFUSED(file.commit(), testing::HasSubstr("a.stl: cannot be written"));
}

TEST(AtomicFile, MoreAtOnceThanAHandlerCanKnowStillVanish) {
  const TempFolder folder;
  {
    std::vector<std::unique_ptr<AtomicFile>> files;
    for (int i = 0; i < 100; ++i) {
      files.push_back(std::make_unique<AtomicFile>(folder / ("f" + std::to_string(i))));
    }
    EXPECT_EQ(folder.file_count(), 100u);
  }
  EXPECT_EQ(folder.file_count(), 0u);
}

TEST(RemoveUnfinishedFiles, LeavesCommittedOnesAlone) {
  const TempFolder folder;
  AtomicFile done(folder / "done.stl");
  done.commit();
  const AtomicFile open(folder / "open.stl");
  remove_unfinished_files();
  EXPECT_TRUE(std::filesystem::exists(folder / "done.stl"));
  EXPECT_EQ(folder.file_count(), 1u);
}

void clean_up(int) {
  remove_unfinished_files();
  _exit(7);
}

TEST(RemoveUnfinishedFiles, WorksInASignalHandler) {
  const TempFolder folder;
  const pid_t child = fork();
  if (child == 0) {
    signal(SIGTERM, clean_up);
    const AtomicFile one(folder / "one.stl"), two(folder / "two.vtu");
    if (folder.file_count() == 2) raise(SIGTERM);
    _exit(1);
  }
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  EXPECT_EQ(WEXITSTATUS(status), 7);
  EXPECT_EQ(folder.file_count(), 0u);
}

TEST(RemoveUnfinishedFiles, ManyTimesOverSlotsAreUsedAgain) {
  const TempFolder folder;
  for (int i = 0; i < 300; ++i) {
    const AtomicFile file(folder / "a.stl");
    remove_unfinished_files();
    ASSERT_EQ(folder.file_count(), 0u) << i;
  }
}

}  // namespace
}  // namespace mesamis
