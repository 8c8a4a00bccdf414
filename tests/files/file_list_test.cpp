// SPDX-License-Identifier: Apache-2.0
#include "mesamis/files/file_list.h"

#include <gmock/gmock.h>

#include "support/temp_folder.h"
#include "support/throws.h"

namespace mesamis::detail {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

TEST(FileList, GivesRegularFilesInTheOrderOfTheirPaths) {
  const TempFolder folder;
  for (const char* name : {"b", "a10", "a2", "sub/c", "sub/deep/d"}) {
    write_bytes(folder / name, name);
  }
  std::filesystem::create_directory_symlink(folder / "sub", folder / "link");
  EXPECT_THAT(files_in(folder.path()), ElementsAre(folder / "a10", folder / "a2", folder / "b"));
  EXPECT_THAT(files_below(folder.path()),
              ElementsAre(folder / "a10", folder / "a2", folder / "b", folder / "sub" / "c",
                          folder / "sub" / "deep" / "d"));
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
  EXPECT_REFUSED(size_of(folder / "none"), HasSubstr("none: cannot be read"));
  EXPECT_REFUSED(size_of(folder.path()), HasSubstr("cannot be read"));
}

}  // namespace
}  // namespace mesamis::detail
