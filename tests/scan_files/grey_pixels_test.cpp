// SPDX-License-Identifier: Apache-2.0
#include "mesamis/scan_files/grey_pixels.h"

#include <gmock/gmock.h>

#include "support/expect_near.h"
#include "support/throws.h"

namespace mesamis::detail {
namespace {

using testing::HasSubstr;

TEST(GreyPixels, TakeOneValueOfThreeThatAreEqual) {
  EXPECT_EQ(require_grey("a.png", {40000, 40000, 40000}, {0, 0}), 40000);
  for (const auto& color :
       {std::array{1U, 1U, 2U}, std::array{1U, 2U, 1U}, std::array{2U, 1U, 1U}}) {
    EXPECT_REFUSED(require_grey("a.png", color, {3, 4}), HasSubstr("at pixel 3, 4"));
  }
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

}  // namespace
}  // namespace mesamis::detail
