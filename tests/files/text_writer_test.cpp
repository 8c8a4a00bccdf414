// SPDX-License-Identifier: Apache-2.0
#include "mesamis/files/text_writer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <limits>

#include "support/temp_folder.h"
#include "support/throws.h"

namespace mesamis {
namespace {

TEST(TextWriter, TheFileAppearsWithCommit) {
  const TempFolder folder;
  {
    TextWriter out(folder / "a.txt");
    out << "nothing";
    EXPECT_FALSE(std::filesystem::exists(folder / "a.txt"));
  }
  EXPECT_EQ(folder.file_count(), 0);
  TextWriter out(folder / "a.txt");
  out << "n = " << 42 << "\n" << 1.5;
  out.commit();
  EXPECT_EQ(read_bytes(folder / "a.txt"), "n = 42\n1.5");
  EXPECT_EQ(folder.file_count(), 1);
}

TEST(TextWriter, MoreThanItsBufferIsWrittenInOrder) {
  const TempFolder folder;
  TextWriter out(folder / "a.txt");
  std::string expected;
  for (int n = 0; n < 500'000; ++n) {
    out << n << " ";
    expected += std::to_string(n) + " ";
  }
  out.commit();
  EXPECT_TRUE(read_bytes(folder / "a.txt") == expected);
}

TEST(TextWriter, ShortestDecimalsAreAppendedWithoutASignOfZero) {
  std::string text;
  for (const double value : {0.1, -0.0, -2.0, 1.0 / 3}) append_shortest(text += ' ', value);
  EXPECT_EQ(text, " 0.1 0 -2 0.3333333333333333");
}

TEST(TextWriter, NumbersReadBackToTheSameBits) {
  const TempFolder folder;
  using Limits = std::numeric_limits<double>;
  for (const double value : {0.1, 1.0 / 3, -0.0, 1e300, Limits::denorm_min(), Limits::max()}) {
    TextWriter out(folder / "a.txt");
    out.number(value);
    out.commit();
    const double back = std::strtod(read_bytes(folder / "a.txt").c_str(), nullptr);
    EXPECT_EQ(back, value);
    EXPECT_EQ(std::signbit(back), std::signbit(value));
  }
}

TEST(TextWriter, DigitsCanBeLimited) {
  const TempFolder folder;
  TextWriter out(folder / "a.txt");
  out.number(1.0 / 3, 3);
  out << " ";
  out.number(123456, 3);
  out.commit();
  EXPECT_EQ(read_bytes(folder / "a.txt"), "0.333 1.23e+05");
}

TEST(TextWriter, WhatIsNotFiniteIsRefused) {
  const TempFolder folder;
  TextWriter out(folder / "a.txt");
  for (const double bad : {double{INFINITY}, double{-INFINITY}, double{NAN}}) {
    EXPECT_REFUSED(out.number(bad), testing::HasSubstr("a.txt: a value to write is not finite"));
    EXPECT_REFUSED(out.number(bad, 5), testing::HasSubstr("not finite"));
  }
}

}  // namespace
}  // namespace mesamis
