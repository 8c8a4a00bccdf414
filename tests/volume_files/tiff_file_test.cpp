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
#include "volume_files/tiff_pages.h"

namespace mesamis {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

TEST(Tiff, ReadsPagesAsSlices) {
  const TempFolder folder;
  const VolumeFile file = read(folder, "a.tif", tiff_bytes(five_pages()));
  expect_ramp(file.volume);
  expect_near(file.volume.spacing, {0.5, 0.5, 1});
  EXPECT_THAT(file.warnings, ElementsAre(HasSubstr("between slices")));
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
