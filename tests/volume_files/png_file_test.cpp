// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "mesamis/volume_files/read_volume.h"
#include "support/expect_near.h"
#include "support/picture_bytes.h"
#include "support/read_scan.h"

namespace mesamis {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

TEST(Png, ReadsOneGreySlice) {
  const TempFolder folder;
  const VolumeFile file = read(folder, "a.png", png_bytes(2, 3, "\x01\x02\x03\xff\x05\x06"));
  EXPECT_EQ(file.format, "PNG");
  EXPECT_EQ(file.volume.size, (std::array<Index, 3>{2, 3, 1}));
  EXPECT_THAT(file.volume.samples, ElementsAre(1, 2, 3, 255, 5, 6));
  EXPECT_THAT(file.warnings,
              ElementsAre(HasSubstr("no resolution: 1 mm"), HasSubstr("between slices: 1 mm")));
}

TEST(Png, TakesTheResolution) {
  const TempFolder folder;
  PngBytes png{
      .width = 1, .height = 1, .pixels_per_metre = 4000, .lines = {std::string("\0\7", 2)}};
  const VolumeFile file = read(folder, "a.png", png.bytes());
  expect_near(file.volume.spacing, {0.25, 0.25, 1});
  EXPECT_EQ(file.warnings.size(), 1U);
}

/// The same picture under each of the five filters, worked out by hand from their definitions.
TEST(Png, UndoesEveryFilter) {
  const TempFolder folder;
  const std::vector<int> first{10, 20, 250}, second{12, 19, 4};
  const auto line = [](int filter, const std::vector<int>& row, const std::vector<int>& above) {
    std::string bytes(1, static_cast<char>(filter));
    for (std::size_t x = 0; x < row.size(); ++x) {
      const int a = x > 0 ? row[x - 1] : 0, b = above[x], c = x > 0 ? above[x - 1] : 0;
      const int p = a + b - c;
      const int pa = std::abs(p - a), pb = std::abs(p - b), pc = std::abs(p - c);
      const int paeth = pa <= pb && pa <= pc ? a : pb <= pc ? b : c;
      const std::vector<int> predicted{0, a, b, (a + b) / 2, paeth};
      bytes += static_cast<char>(row[x] - predicted[static_cast<std::size_t>(filter)]);
    }
    return bytes;
  };
  for (int filter = 0; filter < 5; ++filter) {
    PngBytes png{.width = 3, .height = 2};
    png.lines = {line(filter, first, {0, 0, 0}), line(filter, second, first)};
    EXPECT_THAT(read(folder, "a.png", png.bytes()).volume.samples,
                ElementsAre(10, 20, 250, 12, 19, 4))
        << "filter " << filter;
  }
}

TEST(Png, ReadsEveryDepthAndGreyInColour) {
  const TempFolder folder;
  const auto samples = [&folder](int bits, int color, const std::string& line,
                                 const std::string& palette = "") {
    PngBytes png{.width = 2, .height = 1, .bits = bits, .color = color, .palette = palette};
    png.lines = {'\0' + line};
    return read(folder, "a.png", png.bytes()).volume.samples;
  };
  EXPECT_THAT(samples(1, 0, "\x40"), ElementsAre(0, 1));
  EXPECT_THAT(samples(2, 0, "\x90"), ElementsAre(2, 1));
  EXPECT_THAT(samples(4, 0, "\xe3"), ElementsAre(14, 3));
  EXPECT_THAT(samples(16, 0, "\x9c\x40\x01\x02"), ElementsAre(40000, 258));
  EXPECT_THAT(samples(8, 4, "\x09\xff\x08\xff"), ElementsAre(9, 8)) << "grey and alpha";
  EXPECT_THAT(samples(8, 2, "\5\5\5\6\6\6"), ElementsAre(5, 6));
  EXPECT_THAT(samples(8, 6, "\5\5\5\1\6\6\6\1"), ElementsAre(5, 6));
  EXPECT_THAT(samples(4, 3, std::string("\x01", 1), "\x30\x30\x30\x50\x50\x50"),
              ElementsAre(0x30, 0x50));
}

TEST(Png, RefusesColourInterlacingAndBrokenFiles) {
  const TempFolder folder;
  PngBytes rgb{.width = 1, .height = 1, .color = 2, .lines = {std::string("\0\1\2\3", 4)}};
  EXPECT_THAT(complaint(folder, "a.png", rgb.bytes()), HasSubstr("red 1, green 2, blue 3"));
  PngBytes laced{.width = 1, .height = 1, .interlace = 1, .lines = {std::string("\0\1", 2)}};
  EXPECT_THAT(complaint(folder, "b.png", laced.bytes()), HasSubstr("interlaced"));
  PngBytes odd{.width = 1, .height = 1, .bits = 3, .lines = {std::string("\0\1", 2)}};
  EXPECT_THAT(complaint(folder, "c.png", odd.bytes()), HasSubstr("bit depth"));
  PngBytes filter{.width = 1, .height = 1, .lines = {"\5\1"}};
  EXPECT_THAT(complaint(folder, "d.png", filter.bytes()), HasSubstr("filter 5"));
  const std::string whole = png_bytes(2, 2, "abcd");
  EXPECT_THAT(complaint(folder, "e.png", whole.substr(0, whole.size() - 13)), HasSubstr("cut off"));
  std::string changed = whole;
  changed[45] ^= 1;
  EXPECT_THAT(complaint(folder, "f.png", changed), HasSubstr("checksum"));
  EXPECT_THAT(complaint(folder, "g.png", "no picture"), HasSubstr("expected a PNG file"));
}

/// A small file that claims a huge picture is refused before memory is taken for it.
TEST(Png, ClaimsAreCheckedAgainstTheDataFirst) {
  const TempFolder folder;
  PngBytes huge{.width = 1 << 20, .height = 1 << 19, .bits = 16, .lines = {std::string(64, '\0')}};
  const double before = peak_mb();
  EXPECT_THAT(complaint(folder, "a.png", huge.bytes()), HasSubstr("expected 1099512152064 bytes"));
  huge.width = huge.height = 0x7fffffff;
  EXPECT_THAT(complaint(folder, "b.png", huge.bytes()), HasSubstr("more voxels than can be read"));
  huge.width = 0xffffffff;
  EXPECT_THAT(complaint(folder, "c.png", huge.bytes()), HasSubstr("along axis 0"));
  EXPECT_LT(peak_mb() - before, 50);
  PngBytes less{.width = 4, .height = 4, .lines = {std::string(10, '\0')}};
  EXPECT_THAT(complaint(folder, "d.png", less.bytes()), HasSubstr("expected 20 bytes of pixels"));
}

}  // namespace
}  // namespace mesamis
