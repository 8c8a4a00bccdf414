// SPDX-License-Identifier: Apache-2.0
#include "mesamis/base/written_number.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace mesamis {
namespace {

TEST(WrittenNumber, ReadsTheUsualSpellings) {
  for (const char* five : {"5", "+5", "05", "5.", "5.0", "50e-1", "0.05E2"}) {
    EXPECT_EQ(written_number(five), 5) << five;
  }
  EXPECT_EQ(written_number("-.5"), -0.5);
  EXPECT_EQ(written_number("+.5"), 0.5);
}

TEST(WrittenNumber, RefusesWhateverElse) {
  for (const char* text : {"", "+", "-", ".", "+-5", "++5", "--5", " 5", "5 ", "5mm", "5,0", "0x10",
                           "e3", "nan", "inf", "-inf", "+nan", "1e400", "1e-400"}) {
    EXPECT_FALSE(written_number(text)) << "'" << text << "'";
  }
}

TEST(WrittenNumber, ATakenNumberLeavesTheRest) {
  std::string_view text = "+1.5e2*rho";
  EXPECT_EQ(take_number(text), 150);
  EXPECT_EQ(text, "*rho");
  EXPECT_FALSE(take_number(text));
  EXPECT_EQ(text, "*rho");
  text = "+-5";
  EXPECT_FALSE(take_number(text));
  EXPECT_EQ(text, "+-5");
  text = "3emu";
  EXPECT_EQ(take_number(text), 3);
  EXPECT_EQ(text, "emu");
}

TEST(WrittenNumber, ATextThatIsPartOfAnotherEndsWhereItEnds) {
  const std::string_view whole = "1234";
  EXPECT_EQ(written_number(whole.substr(1, 2)), 23);
}

TEST(WrittenNumber, AWordIsTakenOffTheFrontAlone) {
  std::string_view text = "rho_ash^2";
  EXPECT_FALSE(take(text, "ash"));
  EXPECT_TRUE(take(text, "rho_"));
  EXPECT_EQ(text, "ash^2");
  EXPECT_FALSE(take(text, "ash^2 "));
}

TEST(WrittenNumber, ItsTextReadsBackAsTheSameNumber) {
  for (const double x : {0.1, 1.0 / 3, -2e-300, 1e300, 0.0, 4.9e-324}) {
    EXPECT_EQ(written_number(number_text(x)).value_or(std::nan("")), x);
  }
  EXPECT_EQ(number_text(0.1), "0.1");
  EXPECT_EQ(rounded_text(0.1 + 0.2), "0.3");
  EXPECT_EQ(rounded_text(285.18468755167737, 4), "285.2");
  EXPECT_EQ(rounded_text(-1234567.0, 6), "-1234570");
  EXPECT_EQ(rounded_text(0, 3), "0");
}

TEST(WrittenNumber, ItsSignificantDigitsAreKept) {
  EXPECT_EQ(significant_text(0.3004, 2), "0.30");
  EXPECT_EQ(significant_text(0.0996, 2), "0.10");
  EXPECT_EQ(significant_text(9.96, 2), "10");
  EXPECT_EQ(significant_text(0.00012345, 2), "0.00012");
  EXPECT_EQ(significant_text(-802.71, 3), "-803");
  EXPECT_EQ(significant_text(1234.4, 3), "1234");
  EXPECT_EQ(significant_text(105158, 3), "105 158");
  EXPECT_EQ(significant_text(-999999, 3), "-999 999");
  EXPECT_EQ(significant_text(0, 2), "0.0");
}

/// What is beyond what anybody reads in decimals has an exponent.
TEST(WrittenNumber, LargeAndSmallOnesHaveAnExponent) {
  EXPECT_EQ(significant_text(-1234567.8, 3), "-1.23e+06");
  EXPECT_EQ(significant_text(1e6, 4), "1.000e+06");
  EXPECT_EQ(significant_text(6.25e-32, 4), "6.250e-32");
  EXPECT_EQ(significant_text(62503216379887358094097634033664.0, 4), "6.250e+31");
  EXPECT_EQ(significant_text(1e-4, 2), "0.00010");
  EXPECT_EQ(significant_text(1e300, 3), "1.00e+300");
}

TEST(WrittenNumber, QuotesAreOneShortLine) {
  EXPECT_EQ(quotable("a\nb\tc"), "a b c");
  EXPECT_EQ(quotable(std::string(1000, 'x')), std::string(kMostQuoted, 'x'));
  EXPECT_EQ(quoted_text("a\xc3\nb"),
            "'a?"
            "?b'");
  EXPECT_EQ(quoted_text(std::string(1000, 'x')), "'" + std::string(kMostQuoted, 'x') + "'");
}

}  // namespace
}  // namespace mesamis
