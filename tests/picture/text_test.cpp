// SPDX-License-Identifier: Apache-2.0
#include "mesamis/picture/text.h"

#include <gtest/gtest.h>

#include <string>

#include "page/unpacked.h"

namespace mesamis {
namespace {

constexpr Colour kWhite{255, 255, 255};

/// Where a picture is not white.
struct Ink {
  double sum = 0;  ///< of black, in whole pixels
  int left = 1 << 30, right = -1, top = 1 << 30, bottom = -1;

  explicit Ink(const Raster& picture) {
    for (int y = 0; y < picture.height; ++y) {
      for (int x = 0; x < picture.width; ++x) {
        const int value = pixel(picture, x, y)[0];
        if (value == 255) continue;
        sum += (255 - value) / 255.0;
        left = std::min(left, x);
        right = std::max(right, x);
        top = std::min(top, y);
        bottom = std::max(bottom, y);
      }
    }
  }
};

Ink drawn(const std::string& text, const Lettering& lettering = {40}) {
  Raster picture = blank(400, 100, kWhite);
  draw_text(picture, {50, 50}, text, lettering);
  return Ink(picture);
}

TEST(Text, StandsOnItsPlaceInItsWidth) {
  const Ink ink = drawn("HMMH");
  EXPECT_NEAR((ink.top + ink.bottom + 1) / 2.0, 50, 1);
  EXPECT_NEAR(ink.bottom - ink.top, 0.73 * 40, 2) << "a capital of DejaVu";
  EXPECT_GE(ink.left, 50);
  EXPECT_LE(ink.right, 50 + text_width("HMMH", {40}));
  EXPECT_NEAR(ink.right - ink.left, text_width("HMMH", {40}), 10);
}

TEST(Text, GrowsWithItsHeight) {
  EXPECT_NEAR(text_width("mesh", {60}), 3 * text_width("mesh", {20}), 0.1);
  EXPECT_NEAR(drawn("I", {60}).sum, 9 * drawn("I", {20}).sum, 9 * drawn("I", {20}).sum * 0.1);
}

TEST(Text, OfBoldLettersIsDarker) {
  EXPECT_GT(drawn("mesh", {40, true}).sum, 1.3 * drawn("mesh", {40, false}).sum);
}

/// A letter of two bytes is one letter; halves of one, and letters without a shape, are boxes.
TEST(Text, IsUtf8) {
  EXPECT_LT(text_width("×", {40}), text_width("××", {40}));
  EXPECT_NEAR(text_width("××", {40}), 2 * text_width("×", {40}), 1e-3);
  for (const std::string& odd : {std::string("\xc3"), std::string("\xff\xfe"),
                                 std::string("\xe2\x82"), std::string("\xc0\x80")}) {
    EXPECT_GT(drawn(odd).sum, 0) << "something is seen";
  }
  EXPECT_EQ(text_width("", {40}), 0);
}

TEST(Text, IsCutAtTheBorder) {
  Raster picture = blank(20, 10, kWhite);
  for (const Place& start : {Place{-30, 5}, Place{15, 5}, Place{5, -4}, Place{5, 300}}) {
    draw_text(picture, start, "MMMMMM", {30});
  }
  EXPECT_GT(Ink(picture).sum, 0);
}

TEST(Text, MixesItsColourWithThatBelow) {
  Raster picture = blank(60, 60, {0, 0, 255});
  draw_text(picture, {2, 30}, "M", {50, true, {255, 0, 0}});
  bool pure = false, mixed = false;
  for (int x = 0; x < 60; ++x) {
    const Colour c = pixel(picture, x, 30);
    pure |= c == Colour{255, 0, 0};
    mixed |= c[0] > 20 && c[2] > 20;
    EXPECT_NEAR(c[0] + c[2], 255, 1);
  }
  EXPECT_TRUE(pure);
  EXPECT_TRUE(mixed);
}

}  // namespace
}  // namespace mesamis
