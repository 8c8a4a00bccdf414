// SPDX-License-Identifier: Apache-2.0
#include "mesamis/files/file_list.h"

#include <gmock/gmock.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>

#include "support/as_nobody.h"
#include "support/temp_folder.h"
#include "support/throws.h"

namespace mesamis {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

TEST(FileList, GivesRegularFilesInTheOrderOfTheirPaths) {
  const TempFolder folder;
  for (const char* name : {"b", "a10", "a2", "sub/c", "sub/deep/d"}) {
    write_bytes(folder / name, name);
  }
  EXPECT_THAT(files_in(folder.path()), ElementsAre(folder / "a10", folder / "a2", folder / "b"));
  EXPECT_THAT(files_below(folder.path()),
              ElementsAre(folder / "a10", folder / "a2", folder / "b", folder / "sub" / "c",
                          folder / "sub" / "deep" / "d"));
}

/// A link to a folder elsewhere is followed; links in a circle are entered once.
TEST(FileList, FollowsLinksToFoldersOnce) {
  const TempFolder folder, other;
  write_bytes(folder / "scan/a", "a");
  write_bytes(other / "b", "b");
  std::filesystem::create_directory_symlink(other.path(), folder / "scan/elsewhere");
  std::filesystem::create_directory_symlink(folder / "scan", folder / "scan/itself");
  std::filesystem::create_directory_symlink(other.path(), other / "itself");
  EXPECT_THAT(files_below(folder / "scan"),
              ElementsAre(folder / "scan" / "a", folder / "scan" / "elsewhere" / "b"));
}

TEST(FileList, AMissingFolderIsRefused) {
  const TempFolder folder;
  EXPECT_REFUSED(files_in(folder / "none"), HasSubstr("none: cannot be read"));
  EXPECT_REFUSED(files_below(folder / "none"), HasSubstr("none: cannot be read"));
}

TEST(FileList, SizeIsThatOfAFile) {
  const TempFolder folder;
  write_bytes(folder / "a", "12345");
  EXPECT_EQ(size_of(folder / "a"), 5u);
  EXPECT_REFUSED(size_of(folder / "none"),
                 HasSubstr("none: cannot be read: no such file or directory"));
  EXPECT_REFUSED(size_of(folder.path()), HasSubstr("cannot be read"));
}

/// Each reason in the system's words: what is forbidden is there.
TEST(FileList, WhatCannotBeReachedIsRefusedWithItsReason) {
  const TempFolder folder;
  std::filesystem::create_symlink("loop", folder / "loop");
  ASSERT_EQ(mkfifo((folder / "pipe").c_str(), 0600), 0);
  const std::string long_name(300, 'a');
  for (const auto& require : {require_there, require_file}) {
    EXPECT_NO_THROW(require("/proc/self/status"));
    EXPECT_REFUSED(require(folder / "none"),
                   HasSubstr("none: cannot be read: no such file or directory"));
    EXPECT_REFUSED(require(folder / "loop"), HasSubstr("levels of symbolic links"));
    EXPECT_REFUSED(require(folder / long_name), HasSubstr("cannot be read: file name too long"));
    EXPECT_REFUSED(require(folder / "pipe"), HasSubstr("found neither"));
    EXPECT_REFUSED(require("/dev/null"), HasSubstr("found neither"));
  }
  EXPECT_NO_THROW(require_there(folder.path()));
  EXPECT_REFUSED(require_file(folder.path()), HasSubstr("expected a file, found a directory"));
  EXPECT_EQ(reason_of(EACCES), "permission denied");
}

TEST(FileList, AFileInAForbiddenFolderIsNotCalledMissing) {
  const AsNobody user;
  const TempFolder folder;
  write_bytes(folder / "closed/a", "1");
  std::filesystem::permissions(folder / "closed", std::filesystem::perms::none);
  EXPECT_REFUSED(size_of(folder / "closed/a"), HasSubstr("cannot be read: permission denied"));
  EXPECT_REFUSED(files_in(folder / "closed"), HasSubstr("closed: cannot be read: permission"));
  EXPECT_REFUSED(files_below(folder / "closed"), HasSubstr("closed: cannot be read: permission"));
  EXPECT_TRUE(files_below(folder.path()).empty());  // a closed one further down is skipped
  std::filesystem::permissions(folder / "closed", std::filesystem::perms::owner_all);
}

}  // namespace
}  // namespace mesamis
