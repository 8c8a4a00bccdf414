// SPDX-License-Identifier: Apache-2.0
#include "mesamis/base/utf8.h"

#include <gtest/gtest.h>

namespace mesamis {
namespace {

using namespace std::string_literals;

TEST(Utf8, IsWhatTheStandardSays) {
  for (const char* text : {"", "a", "\x7f", "\xc2\x80", "\xdf\xbf", "\xe0\xa0\x80", "\xed\x9f\xbf",
                           "\xef\xbf\xbf", "\xf0\x90\x80\x80", "\xf4\x8f\xbf\xbf", "a\xc3\xa9z"}) {
    EXPECT_TRUE(is_utf8(text)) << text;
  }
  EXPECT_TRUE(is_utf8("a\0b"s));
}

TEST(Utf8, HasNoLongFormsHalvesOfPairsOrLooseBytes) {
  for (const char* text :
       {"\x80", "\xbf", "\xc0\x80", "\xc1\xbf", "\xc2", "\xc2z", "\xe0\x9f\xbf", "\xe2\x82",
        "\xed\xa0\x80", "\xf0\x8f\xbf\xbf", "\xf4\x90\x80\x80", "\xf5\x80\x80\x80", "\xff"}) {
    EXPECT_FALSE(is_utf8(text)) << text;
  }
}

TEST(Utf8, LinesKeepCharactersAndLoseTheRest) {
  EXPECT_EQ(as_one_line("caf\xc3\xa9 \xf0\x9f\x98\x80"), "caf\xc3\xa9 \xf0\x9f\x98\x80");
  EXPECT_EQ(as_one_line("a\nb\t\x1b[31m\x7f\0c"s), "a?b??[31m??c");
  EXPECT_EQ(as_one_line("\xc2\x9b\x31m \xc2\xa0"), "?1m \xc2\xa0") << "control sequences of C1";
  EXPECT_EQ(as_one_line("\xff\xc3(\xe2\x82"), std::string(2, '?') + "(" + std::string(2, '?'));
  EXPECT_EQ(as_one_line("\xed\xa0\x80"), "???");
}

TEST(Utf8, LongTextsKeepBeginningAndEndWithWholeCharacters) {
  EXPECT_EQ(shortened("12345678901", 11), "12345678901");
  EXPECT_EQ(shortened("123456789012", 11), "1234 ... 12");
  std::string text;
  for (int n = 0; n < 20; ++n) text += "\xf0\x9f\x98\x80";
  for (std::size_t longest = 5; longest < text.size(); ++longest) {
    const std::string line = shortened(text, longest);
    EXPECT_LE(line.size(), longest);
    EXPECT_TRUE(is_utf8(line)) << longest;
  }
}

TEST(Utf8, LinesOfAnyBytesAreUtf8) {
  std::string all;
  for (int a = 0; a < 256; ++a) {
    for (int b = 0; b < 256; ++b) all += {static_cast<char>(a), static_cast<char>(b)};
  }
  EXPECT_TRUE(is_utf8(as_one_line(all)));
  EXPECT_EQ(as_one_line(as_one_line(all)), as_one_line(all));
}

}  // namespace
}  // namespace mesamis
