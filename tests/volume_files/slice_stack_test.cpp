// SPDX-License-Identifier: Apache-2.0
#include "mesamis/volume_files/slice_stack.h"

#include <gmock/gmock.h>

#include <filesystem>
#include <string>

#include "support/dicom_bytes.h"
#include "support/expect_near.h"
#include "support/picture_bytes.h"
#include "support/read_scan.h"
#include "support/wide_budget.h"

namespace mesamis {
namespace {

namespace fs = std::filesystem;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

/// A slice of 2 x 2 pixels of one value.
std::string slice_of(char value) { return png_bytes(2, 2, std::string(4, value)); }

/// The first sample of each slice.
std::vector<float> order_of(const VolumeFile& file) {
  std::vector<float> values;
  for (Index k = 0; k < file.volume.size[2]; ++k) values.push_back(file.volume.at(0, 0, k));
  return values;
}

TEST(NaturalOrder, CountsNumbersAsNumbers) {
  const std::vector<std::string> sorted{"a",
                                        "a1",
                                        "a2",
                                        "a10",
                                        "a10b1",
                                        "a10b12",
                                        "a011",
                                        "b",
                                        "b99999999999999999999998",
                                        "b99999999999999999999999"};
  for (std::size_t i = 0; i < sorted.size(); ++i) {
    for (std::size_t j = 0; j < sorted.size(); ++j) {
      EXPECT_EQ(natural_less(sorted[i], sorted[j]), i < j) << sorted[i] << " " << sorted[j];
    }
  }
  EXPECT_TRUE(natural_less("s01", "s1") != natural_less("s1", "s01")) << "an order, not a tie";
}

TEST(SliceStack, ReadsPicturesInTheOrderOfTheirNumbers) {
  const TempFolder folder;
  for (const int n : {1, 2, 9, 10, 11}) {
    write_bytes(folder / ("slice_" + std::to_string(n) + ".png"), slice_of(static_cast<char>(n)));
  }
  write_bytes(folder / "notes.txt", "not a slice");
  const VolumeFile file = read_volume(folder / "");
  EXPECT_EQ(file.format, "PNG slices");
  EXPECT_EQ(file.volume.size, (std::array<Index, 3>{2, 2, 5}));
  EXPECT_THAT(order_of(file), ElementsAre(1, 2, 9, 10, 11));
  EXPECT_THAT(file.warnings,
              Contains(HasSubstr("slice_9.png follows slice_2.png: is one missing")));
}

TEST(SliceStack, ReadsEveryFormat) {
  const TempFolder folder;
  fs::create_directory(folder / "tif");
  fs::create_directory(folder / "bmp");
  BmpBytes bmp{.palette = grey_palette(), .pixels = std::string("\4\5\6\0\1\2\3\0", 8)};
  for (int k = 0; k < 5; ++k) {
    TiffPage page;
    page.pixels = bytes_of_all(ramp<std::int16_t>(12, -40 + 12 * k));
    const std::string n = std::to_string(8 + k);
    write_bytes(folder / ("tif/" + n + ".TIF"), tiff_bytes({page}));
    write_bytes(folder / ("bmp/" + n + ".bmp"), bmp.bytes());
  }
  const VolumeFile tiff = read_volume(folder / "tif");
  expect_ramp(tiff.volume);
  expect_near(tiff.volume.spacing, {0.5, 0.5, 1});
  EXPECT_EQ(read_volume(folder / "bmp").volume.size, (std::array<Index, 3>{3, 2, 5}));
}

TEST(SliceStack, TakesTheSpacingThatIsGiven) {
  const TempFolder folder;
  for (const char* name : {"1.png", "2.png"}) write_bytes(folder / name, slice_of(1));
  const VolumeFile file = read_volume(folder / "", {.spacing = Vec3{0.1, 0.2, 0.3}});
  expect_near(file.volume.spacing, {0.1, 0.2, 0.3});
  EXPECT_THAT(file.warnings, IsEmpty());
  PngBytes screen{.width = 2, .height = 1, .pixels_per_metre = 3780};
  screen.lines = {std::string("\0\1\2", 3)};
  for (const char* name : {"1.png", "2.png"}) write_bytes(folder / name, screen.bytes());
  EXPECT_THAT(read_volume(folder / "").warnings, Contains(HasSubstr("typical of screens")));
  EXPECT_THAT(read_volume(folder / "", {.spacing = Vec3{1, 1, 1}}).warnings, IsEmpty());
}

TEST(SliceStack, RefusesPicturesThatDoNotFit) {
  const TempFolder folder;
  write_bytes(folder / "1.png", slice_of(1));
  const auto with = [&folder](const std::string& name, const std::string& bytes) {
    write_bytes(folder / name, bytes);
    const std::string why = complaint(folder / "");
    fs::remove(folder / name);
    return why;
  };
  EXPECT_THAT(
      with("2.png", png_bytes(2, 1, "ab")),
      HasSubstr("2.png: expected a slice like the first, PNG of 2 x 2 x 1 pixels of 8 bits"));
  PngBytes deep{.width = 2, .height = 2, .bits = 16};
  deep.lines = {std::string(5, '\0'), std::string(5, '\0')};
  EXPECT_THAT(with("2.png", deep.bytes()), HasSubstr("of 16 bits"));
  BmpBytes bmp{.width = 2, .height = 2, .palette = grey_palette(), .pixels = "abcdefgh"};
  EXPECT_THAT(with("2.bmp", bmp.bytes()), HasSubstr("found BMP"));
  EXPECT_THAT(with("0.png", "no picture"), HasSubstr("0.png: expected a PNG file"));
  EXPECT_THAT(with("2.png", slice_of(2).substr(0, 60)), HasSubstr("2.png"));
}

TEST(SliceStack, IsListedAsOneVolume) {
  const TempFolder folder;
  for (const char* name : {"1.png", "2.png", "3.png"}) write_bytes(folder / name, slice_of(1));
  auto infos = list_volumes(folder / "");
  ASSERT_EQ(infos.size(), 1U);
  EXPECT_EQ(infos[0].size, (std::array<Index, 3>{2, 2, 3}));
  EXPECT_EQ(infos[0].problem, "");
  const Volume volume = read_volume(folder / "").volume;
  EXPECT_EQ(infos[0].spacing, volume.spacing);
  EXPECT_EQ(infos[0].origin, volume.origin);
  EXPECT_EQ(infos[0].direction, volume.direction);
  write_bytes(folder / "3.png", png_bytes(1, 1, "a"));
  EXPECT_THAT(list_volumes(folder / "")[0].problem, HasSubstr("3.png"));
}

TEST(SliceStack, VolumesAndSeriesAreNoSlices) {
  const TempFolder folder;
  TiffPage page;
  page.pixels = bytes_of_all(ramp<std::int16_t>(12));
  write_bytes(folder / "1.tif", tiff_bytes({page, page}));
  write_bytes(folder / "2.tif", tiff_bytes({page, page}));
  WideBudget budget;
  EXPECT_THAT(slices_in(folder / "", budget), IsEmpty()) << "volumes of two slices each";
  EXPECT_EQ(list_volumes(folder / "").size(), 2U);
  fs::create_directory(folder / "series");
  for (int k = 0; k < 3; ++k) {
    SliceBytes slice;
    slice.position = {0, 0, 2.0 * k};
    write_bytes(folder / ("series/" + std::to_string(k)), slice.bytes());
    write_bytes(folder / ("series/preview" + std::to_string(k) + ".png"), slice_of(1));
  }
  EXPECT_EQ(read_volume(folder / "series").format, "DICOM")
      << "the pictures beside it are previews";
}

/// macOS leaves ._s1.png beside s1.png on foreign disks.
TEST(SliceStack, FilesWithALeadingDotAreNoSlices) {
  const TempFolder folder;
  for (const char* name : {"s1.png", "s2.png"}) {
    write_bytes(folder / name, slice_of(name[1]));
    write_bytes(folder / ("._" + std::string(name)), "Mac OS X");
  }
  EXPECT_EQ(read_volume(folder / "").volume.size[2], 2);
}

TEST(SliceStack, SpacingIsThatOfSkyscansLog) {
  const TempFolder folder;
  for (const char* name : {"a_rec0001.png", "a_rec0002.png", "a_rec0003.png"}) {
    write_bytes(folder / name, slice_of(name[8]));
  }
  write_bytes(folder / "a_rec_spr.png", png_bytes(7, 5, std::string(35, 'x')));
  EXPECT_NE(complaint(folder / ""), "") << "a scout of another size";
  write_bytes(folder / "a.log",
              "[System]\r\nScanner=1172\r\n[Acquisition]\r\nPixel Size (um)=99\r\n");
  write_bytes(folder / "a_rec.log",
              "[System]\r\nScanner=1172\r\n[Reconstruction]\r\nPixel Size (um)= 17,50\r\n"
              "Section to Section Step=2\r\n[File name convention]\r\n");
  const VolumeFile file = read_volume(folder / "");
  expect_near(file.volume.spacing, {0.0175, 0.0175, 0.035});
  EXPECT_EQ(file.volume.size[2], 3);
  EXPECT_THAT(file.warnings, ElementsAre(HasSubstr("a_rec.log")));
  EXPECT_EQ(read_volume(folder / "", {.spacing = Vec3{1, 2, 3}}).volume.spacing, (Vec3{1, 2, 3}));
}

TEST(SliceStack, ProjectionsBesideTheirLogAreNoSlices) {
  const TempFolder folder;
  for (const char* name : {"a0001.png", "a0002.png"}) {
    write_bytes(folder / name, png_bytes(3, 2, "abcdef"));
  }
  const std::string log = "[Acquisition]\nImage Pixel Size (um)=20\nNumber of Columns=3\n";
  write_bytes(folder / "a.log", log + "Number of Rows=2\n");
  EXPECT_THAT(complaint(folder / ""), HasSubstr("found the projections of a scan"));
  write_bytes(folder / "a.log", log + "Number of Rows=4\n");
  EXPECT_THAT(read_volume(folder / "").warnings,
              ElementsAre(HasSubstr("that of SkyScan's log"), HasSubstr("projections alone"),
                          HasSubstr("tells of 3 x 4 pixels, the slices have 3 x 2")));
}

TEST(SliceStack, AGivenSpacingCountsBeforeResolutionsThatDiffer) {
  const TempFolder folder;
  for (const char* name : {"s1.png", "s2.png"}) {
    PngBytes png;
    png.width = png.height = 2;
    png.lines = {std::string("\0ab", 3), std::string("\0cd", 3)};
    png.pixels_per_metre = name[1] == '1' ? 2000 : 4000;
    write_bytes(folder / name, png.bytes());
  }
  EXPECT_THAT(complaint(folder / ""), HasSubstr("s2.png"));
  EXPECT_EQ(read_volume(folder / "", {.spacing = Vec3{1, 2, 3}}).volume.spacing, (Vec3{1, 2, 3}));
}

}  // namespace
}  // namespace mesamis
