// SPDX-License-Identifier: Apache-2.0
#include "mesamis/files/refuse.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>

#include "support/throws.h"

namespace mesamis {
namespace {

TEST(Refuse, GivesOneLineWhateverTheTextHolds) {
  EXPECT_REFUSED(refuse("a\nb.stl", "found \x1b[31m\r\nred"),
                 testing::StrEq("a?b.stl: found ?[31m??red"));
  EXPECT_REFUSED(refuse("\xff.stl", "found \xc3\xa9 \xc3"),
                 testing::StrEq("?.stl: found \xc3\xa9 ?"));
}

TEST(Refuse, KeepsBeginningAndEndOfWhatAFileBringsAtLength) {
  EXPECT_REFUSED(
      refuse("a.stl", "found " + std::string(10'000, 'x') + " here"),
      testing::AllOf(testing::StartsWith("a.stl: found x"), testing::HasSubstr("x ... x"),
                     testing::EndsWith("x here"), testing::SizeIs(407)));
}

TEST(Refuse, QuotesAreShortAndPlain) {
  EXPECT_EQ(shown("a\tb\x80\xff~"), "a?b??~");
  EXPECT_EQ(in_quotes("text"), "\"text\"");
  EXPECT_EQ(in_quotes("a\nb"), "\"a?b\"");
  EXPECT_EQ(in_quotes("12345", 5), "\"12345\"");
  EXPECT_EQ(in_quotes("123456", 5), "\"12345...\"");
}

TEST(Refuse, WordsAreTrimmedAndLowered) {
  EXPECT_EQ(lower("aZ\xc4 9_"), "az\xc4 9_");
  EXPECT_EQ(upper("aZ\xe4 9_"), "AZ\xe4 9_");
  EXPECT_EQ(trimmed(std::string_view(" \t\r\n\0 a b \0\v\f", 13)), "a b");
  EXPECT_EQ(trimmed(" \n"), "");
  EXPECT_EQ(trimmed(""), "");
}

TEST(Refuse, LowersTheLastExtensionOfAPath) {
  EXPECT_EQ(lower_extension("folder.D/Scan.nii.GZ"), ".gz");
  EXPECT_EQ(lower_extension("folder.D/Scan"), "");
}

TEST(Refuse, JoinsPartsInTheCLocale) {
  EXPECT_EQ(message("found ", 1234567, " of ", 0.5, '!'), "found 1234567 of 0.5!");
}

TEST(ParseNumber, TakesARealNumberThatFillsTheText) {
  for (const auto& [text, expected] : {std::pair{"1", 1.0},
                                       {"-2.5", -2.5},
                                       {"+3", 3.0},
                                       {".5", 0.5},
                                       {"1e-3", 1e-3},
                                       {"7.", 7.0}}) {
    double value = 0;
    EXPECT_TRUE(parse_number(std::string_view(text), value)) << text;
    EXPECT_EQ(value, expected);
  }
  for (const char* text : {"", "+", "-", "1 ", " 1", "1,5", "1x", "0x10", "--1", "one", "1e999"}) {
    double value = 0;
    EXPECT_FALSE(parse_number(std::string_view(text), value)) << text;
  }
}

TEST(ParseNumber, TakesAWholeNumberOf64Bits) {
  std::int64_t value = 0;
  EXPECT_TRUE(parse_number(std::string_view("-9223372036854775808"), value));
  EXPECT_EQ(value, std::numeric_limits<std::int64_t>::min());
  EXPECT_TRUE(parse_number(std::string_view("+42"), value));
  EXPECT_EQ(value, 42);
  for (const char* text : {"9223372036854775808", "1.0", "1e3", "", "+", "4 2"}) {
    EXPECT_FALSE(parse_number(std::string_view(text), value)) << text;
  }
}

}  // namespace
}  // namespace mesamis
