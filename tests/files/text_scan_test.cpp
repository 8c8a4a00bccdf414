// SPDX-License-Identifier: Apache-2.0
#include "mesamis/files/text_scan.h"

#include <gmock/gmock.h>

#include <string>
#include <vector>

namespace mesamis {
namespace {

using testing::ElementsAre;

TEST(TextScan, WordsStandBetweenBlanks) {
  std::string_view text = " one\ttwo\r\n\v three";
  EXPECT_EQ(take_word(text), "one");
  EXPECT_EQ(take_word(text), "two");
  EXPECT_EQ(take_word(text), "three");
  EXPECT_EQ(take_word(text), "");
  EXPECT_EQ(take_word(text), "");
}

std::vector<std::string> lines_of(std::string_view text) {
  std::vector<std::string> lines;
  for (std::string_view line; take_line(text, line);) lines.emplace_back(line);
  return lines;
}

TEST(TextScan, LinesEndInAnyWayOrWithTheText) {
  EXPECT_THAT(lines_of("a\r\n\nb c\nd"), ElementsAre("a", "", "b c", "d"));
  EXPECT_THAT(lines_of("a\n"), ElementsAre("a"));
  EXPECT_THAT(lines_of("\n"), ElementsAre(""));
  EXPECT_THAT(lines_of("a\rb c\r\rd"), ElementsAre("a", "b c", "", "d")) << "old Macs";
  EXPECT_THAT(lines_of("a\r\r\nb\r"), ElementsAre("a", "b")) << "converted twice";
  EXPECT_THAT(lines_of(""), ElementsAre());
}

}  // namespace
}  // namespace mesamis
