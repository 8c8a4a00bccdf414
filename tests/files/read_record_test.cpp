// SPDX-License-Identifier: Apache-2.0
#include "mesamis/files/read_record.h"

#include <gmock/gmock.h>

#include "mesamis/files/byte_source.h"
#include "support/temp_folder.h"
#include "support/throws.h"

namespace mesamis {
namespace {

std::vector<std::string> names_in(const ReadRecord& record) {
  std::vector<std::string> names;
  for (const ReadFile& file : record.files()) names.push_back(file.path.filename());
  return names;
}

class ReadRecordTest : public testing::Test {
 protected:
  ReadRecordTest() {
    write_bytes(folder_ / "a", "one");
    write_bytes(folder_ / "b", "two");
  }

  void open(const std::string& name) { ByteSource(folder_ / name, Packing::kPlain); }

  TempFolder folder_;
};

TEST_F(ReadRecordTest, NotesEachFileOnceInTheOrderOfPaths) {
  const ReadRecord record;
  open("b");
  open("a");
  open("b");
  EXPECT_THAT(names_in(record), testing::ElementsAre("a", "b"));
}

TEST_F(ReadRecordTest, OnlyTheInnermostNotes) {
  const ReadRecord outer;
  open("a");
  {
    const ReadRecord inner;
    open("b");
    EXPECT_THAT(names_in(inner), testing::ElementsAre("b"));
  }
  EXPECT_THAT(names_in(outer), testing::ElementsAre("a"));
}

TEST_F(ReadRecordTest, NothingIsNotedWhereNobodyAsks) {
  open("a");
  EXPECT_THAT(names_in(ReadRecord()), testing::IsEmpty());
}

TEST_F(ReadRecordTest, AFileThatIsAnotherOneAtTheSecondTimeIsRefused) {
  const ReadRecord record;
  open("a");
  std::filesystem::rename(folder_ / "b", folder_ / "a");
  open("a");
  EXPECT_REFUSED(record.files(), testing::HasSubstr("a: expected a file that stays as it is"));
}

TEST_F(ReadRecordTest, AFileThatWasReplacedWhileItWasOpenedIsRefused) {
  const ReadRecord record;
  const FileState before = state_of(folder_ / "a");
  std::filesystem::rename(folder_ / "b", folder_ / "a");
  EXPECT_REFUSED(note_read(folder_ / "a", before), testing::HasSubstr("found it changed"));
}

TEST_F(ReadRecordTest, AStateIsThatOfOneFile) {
  EXPECT_EQ(state_of(folder_ / "a"), state_of(folder_ / "a"));
  EXPECT_NE(state_of(folder_ / "a"), state_of(folder_ / "b"));
  const ReadFile read{folder_ / "a", state_of(folder_ / "a")};
  EXPECT_NO_THROW(require_unchanged(read));
  write_bytes(folder_ / "a", "longer");
  EXPECT_REFUSED(require_unchanged(read), testing::HasSubstr("found it changed"));
  EXPECT_REFUSED(state_of(folder_ / "none"), testing::HasSubstr("cannot be read"));
}

}  // namespace
}  // namespace mesamis
