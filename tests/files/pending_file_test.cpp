// SPDX-License-Identifier: Apache-2.0
#include "mesamis/files/pending_file.h"

#include <gtest/gtest.h>

#include "support/temp_folder.h"
#include "support/throws.h"

namespace mesamis {
namespace {

namespace fs = std::filesystem;

TEST(PendingFile, ReplacesOnlyWhenTold) {
  const TempFolder folder;
  {
    PendingFile file(folder / "a");
    write_bytes(folder / "a", "old");
    std::ofstream(file.temporary()) << "new";
    file.harden();
    EXPECT_EQ(read_bytes(folder / "a"), "old");
    EXPECT_EQ(file.folder(), fs::absolute(folder.path()));
    file.replace();
  }
  EXPECT_EQ(read_bytes(folder / "a"), "new");
  EXPECT_EQ(folder.file_count(), 1);
}

TEST(PendingFile, IsTakenBackWhetherThereWasAFileOrNot) {
  const TempFolder folder;
  for (const bool there : {false, true}) {
    if (there) write_bytes(folder / "a", "old");
    {
      PendingFile file(folder / "a");
      file.replace();
      EXPECT_EQ(read_bytes(folder / "a"), "");
      file.put_back();
      EXPECT_EQ(fs::exists(folder / "a"), there);
    }
    EXPECT_EQ(read_bytes(folder / "a"), there ? "old" : "");
    EXPECT_EQ(folder.file_count(), there ? 1 : 0);
  }
}

TEST(WithoutLinks, LeadsToTheEndThereOrNot) {
  const TempFolder folder;
  fs::create_symlink("b", folder / "a");
  fs::create_symlink("deep/c", folder / "b");
  EXPECT_EQ(without_links(folder / "a"), folder / "deep/c");
  EXPECT_EQ(without_links("x"), fs::absolute("x"));
  fs::create_symlink("self", folder / "self");
  EXPECT_REFUSED(without_links(folder / "self"), testing::HasSubstr("self: cannot be written"));
}

TEST(FlushFolder, TakesOneThatIsThere) {
  const TempFolder folder;
  flush_folder(folder.path());
  flush_folder(folder / "missing");  // nothing to flush
}

}  // namespace
}  // namespace mesamis
