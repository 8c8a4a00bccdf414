// SPDX-License-Identifier: Apache-2.0
#include "mesamis/slabs/scratch.h"

#include <gtest/gtest.h>

#include "support/temp_folder.h"
#include "support/throws.h"

namespace mesamis {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;

ArchiveWriter numbers(std::vector<int> items) {
  ArchiveWriter archive;
  archive.add(items);
  return archive;
}

TEST(Scratch, MakesItsFolderAndTakesItAway) {
  const TempFolder temp;
  const Scratch scratch(temp / "a/b");
  EXPECT_TRUE(fs::is_directory(scratch.folder()));
  scratch.write("x", numbers({1, 2}));
  const Scratch again(temp / "a/b");
  EXPECT_TRUE(again.has("x")) << "it goes on with what is there";
  again.clear();
  EXPECT_FALSE(fs::exists(temp / "a/b"));
  EXPECT_TRUE(fs::exists(temp / "a"));
}

TEST(Scratch, LeavesTheFilesOfOthers) {
  const TempFolder temp;
  write_bytes(temp / "mine.txt", "stays");
  const Scratch scratch(temp.path());
  scratch.write("x", numbers({1}));
  scratch.clear();
  EXPECT_EQ(read_bytes(temp / "mine.txt"), "stays");
  EXPECT_EQ(temp.file_count(), 1);
}

TEST(Scratch, ReadsWhatWasWritten) {
  const TempFolder temp;
  const Scratch scratch(temp.path());
  EXPECT_FALSE(scratch.has("x"));
  scratch.write("x", numbers({1, 2}));
  scratch.write("x", numbers({3}));
  EXPECT_EQ(scratch.read("x").next<int>(), std::vector<int>{3});
  EXPECT_EQ(std::distance(fs::directory_iterator(scratch.folder()), {}), 1) << "nothing unfinished";
  scratch.remove("x");
  scratch.remove("x");
  EXPECT_FALSE(scratch.has("x"));
}

TEST(Scratch, RefusesWhatItCannotReadOrWrite) {
  const TempFolder temp;
  const Scratch scratch(temp.path());
  EXPECT_REFUSED(scratch.read("x"), AllOf(HasSubstr("/x: "), HasSubstr("found none")));
  fs::create_directory(scratch.path("folder"));
  EXPECT_REFUSED(scratch.read("folder"), HasSubstr("/folder: "));
  EXPECT_REFUSED(scratch.write("folder", numbers({1})), HasSubstr("/folder: "));
  EXPECT_REFUSED(scratch.write("no/such/folder", numbers({1})), HasSubstr("no/such/folder: "));
  write_bytes(temp / "file", "");
  EXPECT_REFUSED(Scratch(temp / "file"), HasSubstr("expected a folder"));
}

}  // namespace
}  // namespace mesamis
