// SPDX-License-Identifier: Apache-2.0
#include "mesamis/picture/raster.h"

#include <gtest/gtest.h>

#include <random>

#include "mesamis/volume_files/read_volume.h"
#include "page/unpacked.h"
#include "support/temp_folder.h"

namespace mesamis {
namespace {

TEST(Png, IsReadBackToTheSamePixels) {
  const TempFolder folder;
  std::mt19937 generator(3);
  Raster noise{37, 21, true, {}};
  for (int n = 0; n < 37 * 21; ++n) {
    noise.bytes.push_back(static_cast<std::uint8_t>(n % 3 == 0 ? generator() % 256 : n % 256));
  }
  write_bytes(folder / "a.png", png_bytes(noise));
  const Volume read = read_volume(folder / "a.png", {}).volume;
  ASSERT_EQ(read.size, (std::array<Index, 3>{37, 21, 1}));
  for (std::size_t n = 0; n < noise.bytes.size(); ++n) {
    ASSERT_EQ(read.samples[n], noise.bytes[n]) << n;
  }
  EXPECT_EQ(png_bytes(noise), png_bytes(noise)) << "no time in it";
}

TEST(Png, OfAColouredPictureHasThreeChannels) {
  const std::string png = png_bytes(blank(2, 3, {200, 100, 0}));
  EXPECT_EQ(png.substr(1, 3), "PNG");
  EXPECT_EQ(png[25], 2) << "colour type";
}

TEST(Halved, IsTheMeanOfFourPixels) {
  const Raster small = halved({2, 2, true, {0, 10, 20, 33}});
  EXPECT_EQ(small.width, 1);
  EXPECT_EQ(small.bytes, std::vector<std::uint8_t>{16});
}

TEST(Enlarged, RepeatsPixels) {
  const Raster large = enlarged({2, 1, true, {7, 9}}, 2, 3);
  EXPECT_EQ(large.width, 4);
  EXPECT_EQ(large.height, 3);
  EXPECT_EQ(pixel(large, 1, 2), (Colour{7, 7, 7}));
  EXPECT_EQ(pixel(large, 2, 0), (Colour{9, 9, 9}));
}

TEST(DrawLine, ColoursWhatIsNearIt) {
  Raster picture = blank(20, 20, {0, 0, 0});
  draw_line(picture, {{{-50, 10}, {70, 10}}}, 2, {255, 128, 0});
  EXPECT_EQ(pixel(picture, 3, 10), (Colour{255, 128, 0}));
  EXPECT_EQ(pixel(picture, 3, 14), (Colour{0, 0, 0}));
  const Raster before = picture;
  draw_line(picture, {{{1e9, 1e9}, {1e9, 2e9}}}, 2, {255, 255, 255});  // far away
  draw_line(picture, {{{-9, -9}, {-5, 30}}}, 2, {255, 255, 255});
  EXPECT_EQ(picture.bytes, before.bytes);
}

TEST(DrawLines, AreOneShape) {
  Raster once = blank(20, 20, {0, 0, 0}), often = once;
  const std::array<Place, 2> line{{{2, 3}, {17, 11}}};
  draw_line(once, line, 1.5, {200, 200, 200});
  draw_lines(often, std::vector(5, line), 1.5, {200, 200, 200});
  EXPECT_EQ(once.bytes, often.bytes);
}

TEST(FillRectangle, MixesWhatItCoversInPart) {
  Raster picture = blank(8, 8, {0, 0, 0});
  fill_rectangle(picture, {{{5.25, 6}, {2.5, -3}}}, {200, 100, 40});
  EXPECT_EQ(pixel(picture, 3, 0), (Colour{200, 100, 40}));
  EXPECT_EQ(pixel(picture, 2, 5), (Colour{100, 50, 20}));
  EXPECT_EQ(pixel(picture, 5, 5), (Colour{50, 25, 10}));
  EXPECT_EQ(pixel(picture, 6, 5), (Colour{0, 0, 0}));
  EXPECT_EQ(pixel(picture, 3, 6), (Colour{0, 0, 0}));
  const Raster before = picture;
  fill_rectangle(picture, {{{20, 20}, {30, 30}}}, {255, 255, 255});
  EXPECT_EQ(picture.bytes, before.bytes);
}

}  // namespace
}  // namespace mesamis
