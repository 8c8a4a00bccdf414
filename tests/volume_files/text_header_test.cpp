// SPDX-License-Identifier: Apache-2.0
#include "mesamis/volume_files/text_header.h"

#include <gmock/gmock.h>

#include "support/temp_folder.h"
#include "support/throws.h"

namespace mesamis {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

TEST(TextHeader, LinesEndAsOnUnixOrOnWindows) {
  const TempFolder folder;
  write_bytes(folder / "a", "one\r\n\ntwo\nlast");
  HeaderLines lines(folder / "a");
  std::vector<std::string> all;
  for (std::string line; lines.next(line);) all.push_back(line);
  EXPECT_THAT(all, ElementsAre("one", "", "two", "last"));
  EXPECT_EQ(lines.position(), 14u);
}

TEST(TextHeader, LinesEndAsOnOldMacsIfTheFirstDoes) {
  const TempFolder folder;
  write_bytes(folder / "a", "one\rtwo\r\r\nx");
  HeaderLines lines(folder / "a");
  std::string line;
  EXPECT_TRUE(lines.next(line) && line == "one");
  EXPECT_TRUE(lines.next(line) && line == "two");
  EXPECT_TRUE(lines.next(line) && line.empty());
  EXPECT_EQ(lines.position(), 9u) << "the first sample may look like the end of a line";
  write_bytes(folder / "b", "one\ntw\ro\n");
  HeaderLines unix_lines(folder / "b");
  EXPECT_TRUE(unix_lines.next(line) && unix_lines.next(line));
  EXPECT_EQ(line, "tw\ro");
}

TEST(TextHeader, ThePositionIsThatBehindTheLine) {
  const TempFolder folder;
  write_bytes(folder / "a", "one\r\n\1\2\3");
  HeaderLines lines(folder / "a");
  std::string line;
  EXPECT_TRUE(lines.next(line));
  EXPECT_EQ(lines.position(), 5u) << "where the samples begin";
}

TEST(TextHeader, ABinaryFileIsNoEndlessLine) {
  const TempFolder folder;
  write_bytes(folder / "a", std::string((1 << 20) + 1, 'x'));
  HeaderLines lines(folder / "a");
  std::string line;
  EXPECT_REFUSED(lines.next(line), HasSubstr("expected a header of at most 1048576 bytes"));
  EXPECT_REFUSED(HeaderLines(folder / "none"), HasSubstr("cannot be read"));
}

/// A header from elsewhere must not choose which files of the machine are read.
TEST(TextHeader, DataLieInTheHeadersFolder) {
  const std::filesystem::path header = "/scans/here/a.mhd";
  EXPECT_EQ(data_path(header, "a.raw", false), "/scans/here/a.raw");
  EXPECT_EQ(data_path(header, "below/..a.raw", false), "/scans/here/below/..a.raw");
  EXPECT_EQ(data_path("a.mhd", "a.raw", false), "a.raw");
  for (const char* name : {"../b.raw", "/etc/shadow", "x/../../b.raw", "..", "x/.."}) {
    EXPECT_REFUSED(
        data_path(header, name, false),
        AllOf(HasSubstr("/scans/here/a.mhd: expected a data file in the header's folder"),
              HasSubstr(name), HasSubstr("--allow-outside")));
  }
  EXPECT_EQ(data_path(header, "/etc/shadow", true), "/etc/shadow");
  EXPECT_EQ(data_path(header, "../b.raw", true), "/scans/here/../b.raw");
}

TEST(TextHeader, DataHaveNamesThatAFileCanHave) {
  const std::filesystem::path header = "folder/a.nhdr";
  const std::string longest(255, 'n'), cut("a.raw\0b", 7);
  EXPECT_EQ(data_path(header, longest, false), "folder/" + longest);
  EXPECT_EQ(data_path(header, "/" + longest + "/a", true), "/" + longest + "/a");
  const auto expect_refused = [&](const std::string& name, bool allow_outside) {
    EXPECT_REFUSED(data_path(header, name, allow_outside),
                   HasSubstr("folder/a.nhdr: expected the name of a data file, found \""));
  };
  expect_refused(longest + "n", false);
  expect_refused("b/" + longest, false);
  expect_refused(std::string(5000, '/'), true);
  for (const bool allow_outside : {false, true}) expect_refused(cut, allow_outside);
}

TEST(TextHeader, APipeIsRefusedWithoutWaiting) {
  const TempFolder folder;
  ASSERT_EQ(mkfifo((folder / "a.nhdr").c_str(), 0600), 0);
  EXPECT_REFUSED(HeaderLines(folder / "a.nhdr"), HasSubstr("found neither"));
}

TEST(TextHeader, WordsAndNumbersStandBetweenWhiteSpace) {
  EXPECT_THAT(words_of(" a\tb  c\n"), ElementsAre("a", "b", "c"));
  EXPECT_THAT(words_of(" "), IsEmpty());
  EXPECT_THAT(numbers_of("a", "spacing", "0.5 -1e3", 2), ElementsAre(0.5, -1000));
  EXPECT_THAT(whole_numbers_of("a", "sizes", "4 3 5", 3), ElementsAre(4, 3, 5));
}

TEST(TextHeader, NumbersThatAreNoneAreNamedWithTheirField) {
  EXPECT_REFUSED(numbers_of("a", "spacing", "1 wide", 2),
                 AllOf(HasSubstr("a: "), HasSubstr("\"spacing\""), HasSubstr("\"wide\"")));
  EXPECT_REFUSED(numbers_of("a", "spacing", "1 2 3", 2), HasSubstr("expected 2 numbers"));
  EXPECT_REFUSED(whole_numbers_of("a", "sizes", "4 2.5", 2), HasSubstr("\"2.5\""));
}

TEST(NumberedNames, AreThoseOfAPattern) {
  using testing::ElementsAre;
  EXPECT_THAT(numbered_names("f", "a%03d.raw 9 11 1"),
              ElementsAre("a009.raw", "a010.raw", "a011.raw"));
  EXPECT_THAT(numbered_names("f", "%d 5 1 -2 2"), ElementsAre("5", "3", "1"));
  EXPECT_THAT(numbered_names("f", "a%d 1 2"), ElementsAre("a1", "a2"));
  for (const char* text :
       {"a%d", "a 1 2 1", "a%s 1 2 1", "a%d 1 2 0", "a%d 2 1 1", "a%d 1 9999999 1", "a%999d 1 2 1",
        "a%d -1 2 1", "a%d 1 99999999999 99999999999"}) {
    EXPECT_REFUSED(numbered_names("f", text), testing::HasSubstr("pattern")) << text;
  }
}

}  // namespace
}  // namespace mesamis
