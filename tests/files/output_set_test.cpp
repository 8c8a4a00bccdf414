// SPDX-License-Identifier: Apache-2.0
#include "mesamis/files/output_set.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <string>
#include <vector>

#include "mesamis/files/atomic_file.h"
#include "support/temp_folder.h"
#include "support/throws.h"

namespace mesamis {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

TEST(OutputSet, FilesAppearTogether) {
  const TempFolder folder;
  write_bytes(folder / "b", "old");
  OutputSet set;
  write_file(set.file(folder / "a"), "new a");
  write_file(set.file(folder / "b"), "new b");
  EXPECT_FALSE(fs::exists(folder / "a"));
  EXPECT_EQ(read_bytes(folder / "b"), "old");
  set.commit();
  EXPECT_EQ(read_bytes(folder / "a"), "new a");
  EXPECT_EQ(read_bytes(folder / "b"), "new b");
  EXPECT_EQ(folder.file_count(), 2);
}

TEST(OutputSet, NoneAppearsWithoutCommit) {
  const TempFolder folder;
  write_bytes(folder / "a", "old");
  {
    OutputSet set;
    write_file(set.file(folder / "a"), "new");
    write_file(set.file(folder / "b"), "new");
    write_file(folder / "c", "alone");
    EXPECT_TRUE(fs::exists(folder / "c")) << "is no file of the set";
  }
  EXPECT_EQ(read_bytes(folder / "a"), "old");
  EXPECT_EQ(folder.file_count(), 2);
}

TEST(OutputSet, TellsItsMembersWhileTheyWait) {
  const TempFolder folder;
  OutputSet set;
  write_file(set.file(folder / "a"), "1");
  write_file(set.file(folder / "b"), "22");
  const auto members = set.members();
  ASSERT_EQ(members.size(), 2u);
  EXPECT_EQ(members[0].target, folder / "a");
  EXPECT_EQ(read_bytes(members[1].temporary), "22");
  set.commit();
  EXPECT_TRUE(set.members().empty());
}

TEST(OutputSet, ASetInASetHandsItsFilesOn) {
  const TempFolder folder;
  OutputSet outer;
  {
    OutputSet inner(&outer);
    write_file(inner.file(folder / "a"), "1");
    inner.commit();
  }
  {
    OutputSet given_up(&outer);
    write_file(given_up.file(folder / "b"), "2");
  }
  EXPECT_FALSE(fs::exists(folder / "a"));
  outer.commit();
  EXPECT_TRUE(fs::exists(folder / "a"));
  EXPECT_EQ(folder.file_count(), 1);
}

TEST(OutputSet, AllAreAsTheyWereIfOneCannotBeRenamed) {
  const TempFolder folder;
  write_bytes(folder / "a", "old");
  OutputSet set;
  for (const char* name : {"a", "b", "c"}) write_file(set.file(folder / name), "new");
  fs::create_directory(folder / "c");
  EXPECT_REFUSED(set.commit(), HasSubstr("c: cannot be written"));
  EXPECT_EQ(read_bytes(folder / "a"), "old");
  EXPECT_FALSE(fs::exists(folder / "b"));
}

TEST(OutputSet, AnUnfinishedMemberIsRemovedBySignalHandlers) {
  const TempFolder folder;
  OutputSet set;
  write_file(set.file(folder / "a"), "whole, but not renamed");
  remove_unfinished_files();
  EXPECT_EQ(folder.file_count(), 0);
}

TEST(RequireWritable, RefusesBeforeTheWorkWhatWouldFailAfterIt) {
  const TempFolder folder;
  require_writable(folder / "a.stl");
  EXPECT_EQ(folder.file_count(), 0);
  fs::create_directory(folder / "d.stl");
  ASSERT_EQ(mkfifo((folder / "pipe.stl").c_str(), 0600), 0);
  fs::create_symlink("nowhere/b.stl", folder / "link.stl");
  for (const char* name : {"d.stl", "pipe.stl", "missing/a.stl", "link.stl"}) {
    EXPECT_REFUSED(require_writable(folder / name), HasSubstr(std::string(name) + ": cannot be"));
  }
  EXPECT_REFUSED(require_writable(folder / std::string(300, 'x')), HasSubstr("name too long"));
  EXPECT_REFUSED(require_writable("/dev/null"), HasSubstr("expected the name of a file"));
}

TEST(RequireDistinct, KnowsAFileByAnyOfItsNames) {
  const TempFolder folder;
  write_bytes(folder / "scan", "x");
  fs::create_directory(folder / "d");
  fs::create_symlink("scan", folder / "link");
  fs::create_hard_link(folder / "scan", folder / "hard");
  fs::create_symlink("later", folder / "to_later");
  const auto refuses = [&](const std::vector<fs::path>& outputs, const char* words) {
    EXPECT_REFUSED(require_distinct(outputs, std::vector{folder / "scan"}), HasSubstr(words));
  };
  refuses({folder / "a", folder / "b", folder / "a"}, "a: expected a file of its own");
  refuses({folder / "a", folder / "d/../a"}, "found it twice");
  refuses({folder / "later", folder / "to_later"}, "found it twice");
  for (const char* name : {"scan", "link", "hard", "d/../scan"}) {
    refuses({folder / name}, "expected another file than the input");
  }
  fs::create_symlink("circle", folder / "circle");
  require_distinct(std::vector{folder / "a"}, std::vector{folder / "circle"});
  require_distinct(std::vector{folder / "a", folder / "b", fs::path(), fs::path()},
                   std::vector{folder / "scan", folder / "missing", fs::path()});
}

}  // namespace
}  // namespace mesamis
