// SPDX-License-Identifier: Apache-2.0
#include "mesamis/volume_files/tiff_tags.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "support/expect_near.h"
#include "volume_files/tiff_pages.h"

namespace mesamis {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

TEST(TiffTags, TakesTheSliceDistanceOfImageJ) {
  const TempFolder folder;
  auto pages = five_pages();
  pages[0].description = "ImageJ=1.53\nimages=5\nslices=5\nunit=mm\nspacing=2.5\n";
  const VolumeFile file = read(folder, "a.tiff", tiff_bytes(pages));
  expect_near(file.volume.spacing, {0.05, 0.05, 2.5});  // 20 pixels per mm
  EXPECT_THAT(file.warnings, IsEmpty());
}

TEST(TiffTags, TheUnitOfImageJComesBeforeTheTag) {
  const TempFolder folder;
  const auto spacing = [&folder](const std::string& unit) {
    auto pages = five_pages();
    pages[0].description = "ImageJ=1.53\nunit=" + unit + "\nspacing=4\n";
    return read(folder, "a.tif", tiff_bytes(pages)).volume.spacing;
  };
  // 20 pixels per unit; the tag says centimetre.
  expect_near(spacing("mm"), {0.05, 0.05, 4});
  expect_near(spacing("cm"), {0.5, 0.5, 40});
  expect_near(spacing("micron"), {5e-5, 5e-5, 4e-3});
  expect_near(spacing("um"), {5e-5, 5e-5, 4e-3});
  expect_near(spacing("pixel"), {1, 1, 1});
  expect_near(spacing("parsec"), {1, 1, 1});
}

TEST(TiffTags, AUnitThatIsNoLengthGivesNoSpacing) {
  const TempFolder folder;
  auto pages = five_pages();
  pages[0].description = "ImageJ=1.53\nimages=5\nslices=5\nunit=pixel\nspacing=4\n";
  write_bytes(folder / "a.tif", tiff_bytes(pages));
  EXPECT_THAT(read_volume(folder / "a.tif").warnings,
              ElementsAre(HasSubstr("\"pixel\" of the description is no length"),
                          HasSubstr("resolution has no unit: 1 mm"),
                          HasSubstr("slices has no unit: 1 mm")));
  const VolumeFile given = read_volume(folder / "a.tif", {.spacing = Vec3{1, 2, 3}});
  EXPECT_EQ(given.volume.spacing, (Vec3{1, 2, 3}));
  EXPECT_THAT(given.warnings, ElementsAre(HasSubstr("no length")));
}

void expect_no_unit(const VolumeFile& file) {
  expect_near(file.volume.spacing, {1, 1, 1});
  EXPECT_THAT(file.warnings,
              ElementsAre(HasSubstr("resolution has no unit"), HasSubstr("slices has no unit")));
}

/// Without its tag the unit is inch in TIFF, but ImageJ takes pixels for the unit then.
TEST(TiffTags, WithoutAUnitImageJCountsPixels) {
  const TempFolder folder;
  auto pages = five_pages();
  pages[0].description = "ImageJ=1.54f\nimages=5\nslices=5\nspacing=20\n";
  std::string bytes = tiff_bytes(pages);
  const auto tag = [](std::uint16_t number) {
    return bytes_of(number) + bytes_of(std::uint16_t{3}) + bytes_of(std::uint32_t{1});
  };
  bytes.replace(bytes.find(tag(296)), 8, tag(297));  // another tag in place of the unit's
  expect_no_unit(read(folder, "a.tif", bytes));
}

TEST(TiffTags, WithoutResolutionOneMillimetreIsTakenWithWarnings) {
  const TempFolder folder;
  auto pages = five_pages();
  for (TiffPage& page : pages) page.pixels_per_cm = 0;
  const VolumeFile file = read(folder, "a.tif", tiff_bytes(pages));
  expect_near(file.volume.spacing, {1, 1, 1});
  EXPECT_THAT(file.warnings, ElementsAre(HasSubstr("gives no resolution: 1 mm"),
                                         HasSubstr("between slices: 1 mm")));
}

/// The tag of LSM in place of the description.
std::string lsm_bytes(std::int32_t slices, std::int32_t times) {
  std::vector<TiffPage> pages(6);
  for (std::size_t n = 0; n < pages.size(); ++n) {
    pages[n].pixels = bytes_of_all(ramp<std::int16_t>(12, static_cast<int>(100 * n)));
  }
  std::string info(508, '\0');
  info.replace(16, 4, bytes_of(slices)).replace(24, 4, bytes_of(times));
  info.replace(40, 24, bytes_of(2e-6) + bytes_of(2e-6) + bytes_of(5e-6));
  pages[0].description = info;
  std::string bytes = tiff_bytes(pages);
  const auto tag = [](std::uint16_t id, std::uint16_t type) {
    return bytes_of(id) + bytes_of(type);
  };
  return bytes.replace(bytes.find(tag(270, 2)), 4, tag(34412, 1));
}

TEST(TiffTags, LsmHasVoxelsInMetresAndTimes) {
  const TempFolder folder;
  const VolumeFile slices = read(folder, "a.lsm", lsm_bytes(6, 1));
  expect_near(slices.volume.spacing, {0.002, 0.002, 0.005});
  EXPECT_EQ(slices.volume.size[2], 6);
  EXPECT_THAT(slices.warnings, IsEmpty());
  EXPECT_THAT(complaint(folder, "b.lsm", lsm_bytes(3, 2)),
              HasSubstr("2 volumes (--volume 0 to 1)"));
  const Volume second = read_volume(folder / "b.lsm", {.volume = 1}).volume;
  EXPECT_EQ(second.size[2], 3);
  EXPECT_EQ(second.samples[0], 300);
  EXPECT_THAT(read(folder, "c.lsm", lsm_bytes(4, 2)).warnings,
              ElementsAre(HasSubstr("2 times of 4 slices, found 6 pages")));
}

TEST(TiffTags, KnowsTheUnitsThatImageJWrites) {
  const TempFolder folder;
  const std::vector<std::pair<std::string, double>> units{
      {"microns", 1e-3}, {"\\u00B5m", 1e-3}, {"inch", 25.4}, {"nm", 1e-6}, {"meter", 1e3}};
  for (const auto& [name, mm] : units) {
    const VolumeFile file =
        described(folder, "ImageJ=1.54f\nimages=5\nslices=5\nunit=" + name + "\nspacing=20\n");
    expect_near(file.volume.spacing, {mm / 20, mm / 20, 20 * mm});
    EXPECT_THAT(file.warnings, IsEmpty()) << name;
  }
}

TEST(TiffTags, ImageJMayNameAUnitForEachAxis) {
  const TempFolder folder;
  const std::string text = "ImageJ=1.54f\nimages=5\nslices=5\nspacing=20\nunit=mm\n";
  const VolumeFile file = described(folder, text + "yunit=um\nzunit=nm\n");
  expect_near(file.volume.spacing, {1. / 20, 1e-3 / 20, 20e-6});
  EXPECT_THAT(file.warnings, IsEmpty());
  expect_near(described(folder, text + "yunit=cm\n").volume.spacing, {1. / 20, 10. / 20, 20});
}

TEST(TiffTags, SaysThatAResolutionHasNoUnit) {
  const TempFolder folder;
  auto pages = five_pages();
  pages[0].description = "ImageJ=1.54f\nimages=5\nslices=5\nspacing=20\n";
  std::string bytes = tiff_bytes(pages);
  // The tag of the unit, of the first page: centimetre becomes none.
  const std::string unit = bytes_of(std::uint16_t{296}) + bytes_of(std::uint16_t{3}) +
                           bytes_of(std::uint32_t{1}) + bytes_of(std::uint32_t{3});
  bytes[bytes.find(unit) + 8] = 1;
  expect_no_unit(read(folder, "a.tif", bytes));
}

TEST(TiffTags, AsksWhetherTheResolutionOfAScreenOrADefaultIsMeant) {
  const TempFolder folder;
  for (const auto& [per_cm, is_screen] :
       {std::pair(72 / 2.54F, true), std::pair(96 / 2.54F, true), std::pair(1 / 2.54F, true),
        std::pair(1.F, true), std::pair(20.F, false)}) {
    auto pages = five_pages();
    for (TiffPage& page : pages) page.pixels_per_cm = per_cm;
    const auto warnings = read(folder, "a.tif", tiff_bytes(pages)).warnings;
    EXPECT_EQ(std::ranges::any_of(warnings,
                                  [](const std::string& w) {
                                    return w.find("is typical of ") != std::string::npos;
                                  }),
              is_screen)
        << per_cm;
  }
}

}  // namespace
}  // namespace mesamis
