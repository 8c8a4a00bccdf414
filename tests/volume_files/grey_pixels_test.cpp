// SPDX-License-Identifier: Apache-2.0
#include "mesamis/volume_files/grey_pixels.h"

#include <gmock/gmock.h>

#include "support/expect_near.h"
#include "support/throws.h"

namespace mesamis {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

TEST(GreyPixels, TakeOneValueOfThreeThatAreEqual) {
  EXPECT_EQ(require_grey("a.png", {40000, 40000, 40000}, {0, 0}), 40000);
  for (const auto& color :
       {std::array{1U, 1U, 2U}, std::array{1U, 2U, 1U}, std::array{2U, 1U, 1U}}) {
    EXPECT_REFUSED(require_grey("a.png", color, {3, 4}), HasSubstr("at pixel 3, 4"));
  }
}

TEST(GreyPixels, MakeASliceLineByLine) {
  ScanFile scan{"a.png", "PNG", {}, {}, {"a warning"}};
  scan.grid.size = {3, 2, 1};
  const auto color_at = [](std::int64_t x, std::int64_t y) {
    const auto grey = static_cast<unsigned>(10 * y + x);
    return std::array{grey, grey, grey};
  };
  const VolumeFile slice = grey_picture(scan, color_at);
  EXPECT_THAT(slice.volume.samples, ElementsAre(0, 1, 2, 10, 11, 12));
  EXPECT_EQ(slice.volume.size, scan.grid.size);
  EXPECT_EQ(slice.format, "PNG");
  EXPECT_EQ(slice.warnings, scan.warnings);
  EXPECT_REFUSED(grey_picture(scan,
                              [](std::int64_t x, std::int64_t y) {
                                return std::array{0U, 0U, x == 2 && y == 1 ? 1U : 0U};
                              }),
                 HasSubstr("a.png: expected a grey picture, found red 0, green 0, blue 1 at pixel "
                           "2, 1"));
}

TEST(PictureGrid, TakesTheSpacingOrWarns) {
  ScanFile scan;
  set_picture_grid(scan, {5, 7}, {0.25, 0.5, 0});
  EXPECT_EQ(scan.grid.size, (std::array<Index, 3>{5, 7, 1}));
  expect_near(scan.grid.spacing, {0.25, 0.5, 1});
  EXPECT_EQ(scan.warnings.size(), 1U);
  set_picture_grid(scan, {5, 7}, {});
  expect_near(scan.grid.spacing, {1, 1, 1});
  EXPECT_EQ(scan.warnings.size(), 3U);
}

TEST(GreyPixels, OfAScreenAreAWarning) {
  for (const double per_inch : {72.0, 96.0, 72.009, 95.9866}) {
    std::vector<std::string> warnings;
    warn_of_screen_resolution(25.4 / per_inch, warnings);
    EXPECT_THAT(warnings, ElementsAre(HasSubstr("pixels per inch is typical of screens")))
        << per_inch;
  }
  std::vector<std::string> warnings;
  for (const double mm : {1.0, 0.25, 0.02, 25.4 / 300, 25.4 / 73}) {
    warn_of_screen_resolution(mm, warnings);
  }
  EXPECT_TRUE(warnings.empty());
}

TEST(GreyPixels, KeepATableOfColours) {
  ScanFile scan{"a.png", "PNG", {}, {}, {}};
  keep_palette(scan, std::string_view("\0\0\0\1\2\xff", 6));
  EXPECT_THAT(scan.palette, ElementsAre(ElementsAre(0, 0, 0), ElementsAre(1, 2, 255)));
  EXPECT_TRUE(scan.warnings.empty());
}

}  // namespace
}  // namespace mesamis
