// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "mesamis/volume_files/read_volume.h"
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

TEST(Tiff, TheUnitOfImageJComesBeforeTheTag) {
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

TEST(Tiff, AUnitThatIsNoLengthGivesNoSpacing) {
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

/// Without its tag the unit is inch in TIFF, but ImageJ takes pixels for the unit then.
TEST(Tiff, WithoutAUnitImageJCountsPixels) {
  const TempFolder folder;
  auto pages = five_pages();
  pages[0].description = "ImageJ=1.54f\nimages=5\nslices=5\nspacing=20\n";
  std::string bytes = tiff_bytes(pages);
  const auto tag = [](std::uint16_t number) {
    return bytes_of(number) + bytes_of(std::uint16_t{3}) + bytes_of(std::uint32_t{1});
  };
  bytes.replace(bytes.find(tag(296)), 8, tag(297));  // another tag in place of the unit's
  const VolumeFile file = read(folder, "a.tif", bytes);
  expect_near(file.volume.spacing, {1, 1, 1});
  EXPECT_THAT(file.warnings,
              ElementsAre(HasSubstr("resolution has no unit"), HasSubstr("slices has no unit")));
}

TEST(Tiff, WithoutResolutionOneMillimetreIsTakenWithWarnings) {
  const TempFolder folder;
  auto pages = five_pages();
  for (TiffPage& page : pages) page.pixels_per_cm = 0;
  const VolumeFile file = read(folder, "a.tif", tiff_bytes(pages));
  expect_near(file.volume.spacing, {1, 1, 1});
  EXPECT_THAT(file.warnings, ElementsAre(HasSubstr("gives no resolution: 1 mm"),
                                         HasSubstr("between slices: 1 mm")));
}

TEST(Tiff, ReadsEveryTypeOfGreySamples) {
  const TempFolder folder;
  const auto first = [&folder](TiffPage page) {
    page.width = 2;
    page.height = 1;
    return read(folder, "a.tif", tiff_bytes({page, page})).volume.samples[0];
  };
  constexpr std::uint16_t kUnsigned = 1, kSigned = 2, kReal = 3;
  const auto page = [](std::uint16_t bits, std::uint16_t format, const std::string& sample) {
    TiffPage made;
    made.bits = bits;
    made.format = format;
    made.pixels = sample + sample;
    return made;
  };
  EXPECT_EQ(first(page(8, kUnsigned, "\xc8")), 200);
  EXPECT_EQ(first(page(8, kSigned, "\xff")), -1);
  EXPECT_EQ(first(page(16, kUnsigned, bytes_of(std::uint16_t{40000}))), 40000);
  EXPECT_EQ(first(page(32, kSigned, bytes_of(std::int32_t{-70000}))), -70000);
  EXPECT_EQ(first(page(32, kReal, bytes_of(0.25F))), 0.25F);
  const auto half = [&](int bits) {
    return first(page(16, kReal, bytes_of(static_cast<std::uint16_t>(bits))));
  };
  EXPECT_EQ(half(0x3555), 0.333251953125F);
  EXPECT_EQ(half(0xfbff), -65504);
  EXPECT_EQ(half(0x0001), 0x1p-24F) << "the least number";
  EXPECT_EQ(half(0x83ff), -1023 * 0x1p-24F);
  EXPECT_EQ(half(0x6400), 1024);
  EXPECT_EQ(first(page(64, kReal, bytes_of(-1e10))), -1e10F);
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

TEST(Tiff, LsmHasVoxelsInMetresAndTimes) {
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

TEST(Tiff, SamplesOfNoFormatAreWholeNumbers) {
  const TempFolder folder;
  auto pages = five_pages();
  for (TiffPage& page : pages) page.format = 4;
  const VolumeFile file = read(folder, "a.tif", tiff_bytes(pages));
  EXPECT_EQ(file.volume.samples[0], 65536 - 40);
  EXPECT_THAT(file.warnings, testing::Contains(HasSubstr("taken as whole numbers")));
}

TEST(Tiff, KeepsTheValuesOfInvertedPagesAndWarns) {
  const TempFolder folder;
  auto pages = five_pages();
  for (TiffPage& page : pages) page.photometric = 0;
  const VolumeFile file = read(folder, "a.tif", tiff_bytes(pages));
  expect_ramp(file.volume);
  EXPECT_THAT(file.warnings, testing::Contains(HasSubstr("shown white")));
}

TEST(Tiff, NothingIsPrintedForBrokenFiles) {
  const TempFolder folder;
  std::string broken = tiff_bytes(five_pages());
  broken[broken.size() - 20] ^= 0x55;
  testing::internal::CaptureStderr();
  complaint(folder, "a.tif", broken);
  complaint(folder, "b.tif", broken.substr(0, broken.size() - 30));
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
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

/// A stack of five pages with a description, and how long their pixels are.
VolumeFile described(const TempFolder& folder, const std::string& text,
                     const ReadOptions& options = {}) {
  auto pages = five_pages();
  pages[0].description = text;
  write_bytes(folder / "a.tif", tiff_bytes(pages));
  return read_volume(folder / "a.tif", options);
}

TEST(Tiff, KnowsTheUnitsThatImageJWrites) {
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

TEST(Tiff, ImageJMayNameAUnitForEachAxis) {
  const TempFolder folder;
  const std::string text = "ImageJ=1.54f\nimages=5\nslices=5\nspacing=20\nunit=mm\n";
  const VolumeFile file = described(folder, text + "yunit=um\nzunit=nm\n");
  expect_near(file.volume.spacing, {1. / 20, 1e-3 / 20, 20e-6});
  EXPECT_THAT(file.warnings, IsEmpty());
  expect_near(described(folder, text + "yunit=cm\n").volume.spacing, {1. / 20, 10. / 20, 20});
}

TEST(Tiff, SaysThatAResolutionHasNoUnit) {
  const TempFolder folder;
  auto pages = five_pages();
  pages[0].description = "ImageJ=1.54f\nimages=5\nslices=5\nspacing=20\n";
  std::string bytes = tiff_bytes(pages);
  // The tag of the unit, of the first page: centimetre becomes none.
  const std::string unit = bytes_of(std::uint16_t{296}) + bytes_of(std::uint16_t{3}) +
                           bytes_of(std::uint32_t{1}) + bytes_of(std::uint32_t{3});
  bytes[bytes.find(unit) + 8] = 1;
  const VolumeFile file = read(folder, "a.tif", bytes);
  expect_near(file.volume.spacing, {1, 1, 1});
  EXPECT_THAT(file.warnings,
              ElementsAre(HasSubstr("resolution has no unit"), HasSubstr("slices has no unit")));
}

TEST(Tiff, ValuesOfImageJAreCalibrated) {
  const TempFolder folder;
  const VolumeFile file = described(
      folder, "ImageJ=1.11a\nimages=5\nslices=5\nunit=mm\nspacing=1\ncf=0\nc0=-7\nc1=0.5\n");
  expect_ramp(file.volume, 5, 0.5, -7);
}

TEST(Tiff, TheOriginOfImageJIsAPixel) {
  const TempFolder folder;
  const VolumeFile file = described(
      folder, "ImageJ=1.54f\nimages=5\nslices=5\nunit=mm\nspacing=2\nxorigin=4\nzorigin=-1\n");
  expect_near(file.volume.origin, {-0.2, 0, 2});
}

TEST(Tiff, ChannelsOfOneSliceAreNoVolume) {
  const TempFolder folder;
  auto pages = five_pages();
  pages[0].description = "ImageJ=1.54f\nimages=5\nchannels=5\nunit=mm\n";
  EXPECT_THAT(complaint(folder, "a.tif", tiff_bytes(pages)),
              HasSubstr("expected slices, found 5 channels of one slice each"));
  EXPECT_REFUSED(read_volume(folder / "a.tif", {.channel = 1}), HasSubstr("one slice is none"));
  write_bytes(folder / "b.tif", tiff_bytes(pages));
  const Volume slices = read_volume(folder / "", {.channel = 3}).volume;
  EXPECT_EQ(slices.size[2], 2) << "a channel of a folder of slices";
  EXPECT_EQ(slices.samples[0], -40 + 36);
  EXPECT_REFUSED(read_volume(folder / ""), HasSubstr("--channel 0 to 4"));
}

TEST(Tiff, TakesOneChannelOfAHyperstack) {
  const TempFolder folder;
  auto pages = five_pages();
  pages.push_back(pages[0]);
  pages[0].description = "ImageJ=1.54f\nimages=6\nchannels=2\nslices=3\nunit=mm\nspacing=2\n";
  EXPECT_THAT(complaint(folder, "a.tif", tiff_bytes(pages)), HasSubstr("2 channels"));
  const Volume second = read_volume(folder / "a.tif", {.channel = 1}).volume;
  EXPECT_EQ(second.size[2], 3);
  EXPECT_EQ(second.samples[0], -40 + 12);
  EXPECT_EQ(second.samples[12], -40 + 36);
  const auto listed = list_volumes(folder / "a.tif");
  EXPECT_THAT(listed[0].problem, HasSubstr("--channel 0 to 1"));
}

/// As ImageJ writes stacks of more than 4 GB.
TEST(Tiff, ReadsTheImagesBehindOneDirectory) {
  const TempFolder folder;
  TiffPage page;
  page.description = "ImageJ=1.54f\nimages=5\nslices=5\nunit=mm\nspacing=2\n";
  page.pixels = bytes_of_all(kRamp);
  const std::string bytes = tiff_bytes({page});
  expect_ramp(read(folder, "a.tif", bytes).volume);
  page.description = "ImageJ=1.54f\nimages=12\nslices=12\n";
  EXPECT_THAT(complaint(folder, "b.tif", tiff_bytes({page})), HasSubstr("bytes for 12 images"));
}

TEST(Tiff, OmeHasItsOwnSizesAndOrder) {
  const TempFolder folder;
  const std::string text =
      "<?xml version=\"1.0\"?><OME><Image><Pixels SizeX=\"4\" SizeY=\"3\" SizeZ=\"5\" SizeC=\"1\" "
      "SizeT=\"1\" DimensionOrder=\"XYZCT\" PhysicalSizeX=\"500\" PhysicalSizeY=\"1250\" "
      "PhysicalSizeZ=\"2\" PhysicalSizeZUnit=\"mm\"><TiffData IFD=\"4\" FirstZ=\"0\"/>"
      "<TiffData IFD=\"0\" FirstZ=\"1\" PlaneCount=\"4\"/></Pixels></Image></OME>";
  const VolumeFile file = described(folder, text);
  expect_near(file.volume.spacing, {0.5, 1.25, 2});
  EXPECT_THAT(file.warnings, IsEmpty());
  EXPECT_EQ(file.volume.samples[0], -40 + 48);
  EXPECT_EQ(file.volume.samples[12], -40);
}

TEST(Tiff, WarnsOfPagesThatAreMeantToBeTurned) {
  const TempFolder folder;
  std::string bytes = tiff_bytes(five_pages());
  // The tag of the samples' count becomes that of the orientation, on the first page.
  const std::string samples = bytes_of(std::uint16_t{277}) + bytes_of(std::uint16_t{3});
  const std::string turned = bytes_of(std::uint16_t{274}) + bytes_of(std::uint16_t{3}) +
                             bytes_of(std::uint32_t{1}) + bytes_of(std::uint32_t{4});
  bytes.replace(bytes.find(samples), 12, turned);
  EXPECT_THAT(read(folder, "a.tif", bytes).warnings, testing::Contains(HasSubstr("Orientation 4")));
}

TEST(Tiff, ReadsPixelsOfLessThanAByte) {
  const TempFolder folder;
  TiffPage page{9, 2, 1, 1, 1, 1, 0, "", "\xa0\x80\x01"};
  page.pixels += '\0';
  EXPECT_THAT(read(folder, "a.tif", tiff_bytes({page, page})).volume.samples,
              ElementsAre(1, 0, 1, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 1, 0,  //
                          1, 0, 1, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 1, 0));
  page = {3, 1, 2, 1, 1, 1, 0, "", "\xd8"};
  EXPECT_THAT(read(folder, "b.tif", tiff_bytes({page})).volume.samples, ElementsAre(3, 1, 2));
  page = {3, 1, 4, 1, 1, 1, 0, "", "\xe3\x70"};
  EXPECT_THAT(read(folder, "c.tif", tiff_bytes({page})).volume.samples, ElementsAre(14, 3, 7));
  page.pixels = "\xe3";
  EXPECT_THAT(complaint(folder, "d.tif", tiff_bytes({page}).substr(0, 9)), HasSubstr("TIFF"));
}

TEST(Tiff, NamesACompressionThatNobodyDecodes) {
  const TempFolder folder;
  auto pages = five_pages();
  for (TiffPage& page : pages) page.compression = 34712;
  EXPECT_THAT(complaint(folder, "a.tif", tiff_bytes(pages)), HasSubstr("compression 34712"));
}

TEST(Tiff, AsksWhetherTheResolutionOfAScreenOrADefaultIsMeant) {
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

TEST(Tiff, TablesOfColoursMustBeAlike) {
  const TempFolder folder;
  TiffPage page{2, 1, 4, 1, 1, 3, 0, "", "\x12"};
  page.colours = std::vector<std::uint16_t>(48);
  TiffPage other = page;
  other.colours[7] = 0xff00;
  EXPECT_THAT(read(folder, "a.tif", tiff_bytes({page, page})).volume.samples,
              ElementsAre(1, 2, 1, 2));
  EXPECT_THAT(complaint(folder, "b.tif", tiff_bytes({page, other})),
              HasSubstr("another one on page 1"));
}

}  // namespace
}  // namespace mesamis
