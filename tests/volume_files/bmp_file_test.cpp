// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "mesamis/volume_files/read_volume.h"
#include "support/expect_near.h"
#include "support/picture_bytes.h"
#include "support/read_scan.h"

namespace mesamis {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

const std::string kSixPixels("\4\5\6\0\1\2\3\0", 8);  // the last line first, padded

TEST(Bmp, ReadsGreyLinesFromTheBottomOrTheTop) {
  const TempFolder folder;
  BmpBytes bmp{.pixels_per_metre = 2000, .palette = grey_palette(), .pixels = kSixPixels};
  const VolumeFile file = read(folder, "a.bmp", bmp.bytes());
  EXPECT_EQ(file.format, "BMP");
  EXPECT_EQ(file.volume.size, (std::array<Index, 3>{3, 2, 1}));
  EXPECT_THAT(file.volume.samples, ElementsAre(1, 2, 3, 4, 5, 6));
  expect_near(file.volume.spacing, {0.5, 0.5, 1});
  EXPECT_THAT(file.warnings, ElementsAre(HasSubstr("between slices: 1 mm")));
  bmp.height = -2;
  EXPECT_THAT(read(folder, "b.bmp", bmp.bytes()).volume.samples, ElementsAre(4, 5, 6, 1, 2, 3));
}

TEST(Bmp, ReadsGreyInColour) {
  const TempFolder folder;
  BmpBytes bmp{.width = 1, .height = 1, .bits = 24, .pixels = std::string("\7\7\7\0", 4)};
  EXPECT_THAT(read(folder, "a.bmp", bmp.bytes()).volume.samples, ElementsAre(7));
  bmp.bits = 32;
  EXPECT_THAT(read(folder, "b.bmp", bmp.bytes()).volume.samples, ElementsAre(7));
  bmp.pixels[1] = 8;
  EXPECT_THAT(complaint(folder, "c.bmp", bmp.bytes()), HasSubstr("red 7, green 8, blue 7"));
}

TEST(Bmp, ReadsPixelsOfLessThanAByte) {
  const TempFolder folder;
  BmpBytes bmp{.width = 9, .height = -1, .bits = 1};
  bmp.palette = std::string("\0\0\0\0\xff\xff\xff\0", 8);
  bmp.pixels = std::string("\xa0\x80\0\0", 4);
  EXPECT_THAT(read(folder, "a.bmp", bmp.bytes()).volume.samples,
              ElementsAre(255, 0, 255, 0, 0, 0, 0, 0, 255));
  bmp = {.width = 3, .height = -1, .bits = 4, .colors = 3};
  bmp.palette = std::string("\1\1\1\0\5\5\5\0\7\7\7\0", 12);
  bmp.pixels = std::string("\x21\0\0\0", 4);
  EXPECT_THAT(read(folder, "b.bmp", bmp.bytes()).volume.samples, ElementsAre(7, 5, 1));
  bmp.pixels[0] = '\x31';
  EXPECT_THAT(complaint(folder, "c.bmp", bmp.bytes()), HasSubstr("names colour 3 of 3"));
}

TEST(Bmp, RefusesWhatItCannotReadAndWhatIsNotThere) {
  const TempFolder folder;
  const BmpBytes good{.palette = grey_palette(), .pixels = kSixPixels};
  BmpBytes bmp = good;
  bmp.compression = 1;
  EXPECT_THAT(complaint(folder, "a.bmp", bmp.bytes()), HasSubstr("compression 1"));
  bmp = good;
  bmp.bits = 16;
  EXPECT_THAT(complaint(folder, "b.bmp", bmp.bytes()), HasSubstr("found 16 bits"));
  bmp = good;
  bmp.colors = 3;
  EXPECT_THAT(complaint(folder, "c.bmp", bmp.bytes()), HasSubstr("names colour 3 of 3"));
  const std::string whole = good.bytes();
  EXPECT_THAT(complaint(folder, "d.bmp", whole.substr(0, whole.size() - 1)),
              HasSubstr("expected 1086 bytes for 3 x 2 pixels of 8 bits, found 1085"));
  EXPECT_THAT(complaint(folder, "e.bmp", "BM"), HasSubstr("expected a BMP file"));
}

TEST(Bmp, ClaimsAreCheckedAgainstTheFileFirst) {
  const TempFolder folder;
  BmpBytes bmp{.width = 1 << 20, .height = 1 << 19, .bits = 32, .pixels = "1234"};
  const double before = peak_mb();
  EXPECT_THAT(complaint(folder, "a.bmp", bmp.bytes()), HasSubstr("expected 2199023255606 bytes"));
  bmp.width = bmp.height = 0x7fffffff;
  EXPECT_THAT(complaint(folder, "b.bmp", bmp.bytes()), HasSubstr("more voxels than can be read"));
  bmp.height = 0;
  EXPECT_THAT(complaint(folder, "c.bmp", bmp.bytes()), HasSubstr("along axis 1"));
  bmp.height = 1 << 31;
  EXPECT_NE(complaint(folder, "d.bmp", bmp.bytes()), "");
  EXPECT_LT(peak_mb() - before, 50);
}

}  // namespace
}  // namespace mesamis
