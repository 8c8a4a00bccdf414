// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "mesamis/io/read_volume.h"
#include "support/expect_near.h"
#include "support/read_scan.h"
#include "support/scan_bytes.h"
#include "support/temp_folder.h"

namespace mesamis {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

std::vector<TiffPage> five_pages() {
  std::vector<TiffPage> pages(5);
  for (std::size_t k = 0; k < 5; ++k) {
    pages[k].pixels = bytes_of_all(ramp<std::int16_t>(12, -40 + 12 * static_cast<int>(k)));
  }
  return pages;
}

TEST(Tiff, ReadsPagesAsSlices) {
  const TempFolder folder;
  const VolumeFile file = read(folder, "a.tif", tiff_bytes(five_pages()));
  expect_ramp(file.volume);
  expect_near(file.volume.spacing, {0.5, 0.5, 1});
  EXPECT_THAT(file.warnings, ElementsAre(HasSubstr("between slices")));
}

TEST(Tiff, TakesTheSliceDistanceOfImageJ) {
  const TempFolder folder;
  auto pages = five_pages();
  pages[0].description = "ImageJ=1.53\nimages=5\nslices=5\nunit=mm\nspacing=2.5\n";
  const VolumeFile file = read(folder, "a.tiff", tiff_bytes(pages));
  expect_near(file.volume.spacing, {0.05, 0.05, 2.5});  // 20 pixels per mm
  EXPECT_THAT(file.warnings, IsEmpty());
}

TEST(Tiff, RefusesColourMixedPagesAndCutOffFiles) {
  const TempFolder folder;
  auto pages = five_pages();
  pages[3].width = 3;
  EXPECT_THAT(complaint(folder, "a.tif", tiff_bytes(pages)), HasSubstr("page 3"));
  pages = five_pages();
  for (TiffPage& page : pages) page.photometric = 8;
  EXPECT_THAT(complaint(folder, "b.tif", tiff_bytes(pages)), HasSubstr("photometric 8"));
  TiffPage rgb{2, 2, 8, 3, 1, 2, 0, "", std::string(12, 'x')};
  EXPECT_THAT(complaint(folder, "c.tif", tiff_bytes({rgb, rgb})), HasSubstr("3 channels"));
  const std::string whole = tiff_bytes(five_pages());
  EXPECT_THAT(complaint(folder, "d.tif", whole.substr(0, whole.size() / 2)), HasSubstr("cut off"));
  EXPECT_THAT(complaint(folder, "e.tif", whole.substr(0, 9)), HasSubstr("TIFF"));
}

}  // namespace
}  // namespace mesamis
