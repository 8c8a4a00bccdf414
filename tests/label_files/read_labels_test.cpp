// SPDX-License-Identifier: Apache-2.0
#include "mesamis/label_files/read_labels.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "support/jpeg_bytes.h"
#include "support/picture_bytes.h"
#include "support/scan_bytes.h"
#include "support/seg_bytes.h"
#include "support/temp_folder.h"
#include "support/throws.h"

namespace mesamis {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::ElementsAreArray;
using testing::HasSubstr;
using testing::Not;
using testing::SizeIs;
using testing::StartsWith;

const std::vector<std::int16_t> kLabels = ramp<std::int16_t>(60, 0);

LabelFile read(const TempFolder& folder, const std::string& name, const std::string& bytes) {
  write_bytes(folder / name, bytes);
  return read_label_map(folder / name);
}

/// Labels 0, 1, 2, ... of 4 x 3 x 5 voxels, and a segment for each but the background.
void expect_counted(const LabelFile& file, const std::string& format) {
  EXPECT_EQ(file.format, format);
  EXPECT_THAT(file.map.size, ElementsAre(4, 3, 5));
  ASSERT_THAT(file.map.layers, SizeIs(1));
  EXPECT_THAT(file.map.layers[0], ElementsAreArray(kLabels));
  ASSERT_THAT(file.map.segments, SizeIs(59));
  EXPECT_EQ(file.map.segments[4], (Segment{"label 5", 5, 0, default_colour(5)}));
  EXPECT_NO_THROW(require_valid(file.map));
}

TEST(ReadLabels, OfEveryFormatOfScans) {
  const TempFolder folder;
  const std::string data = bytes_of_all(kLabels), nifti = NiftiBytes{}.header() + data;
  expect_counted(read(folder, "a.nii", nifti), "NIfTI");
  expect_counted(read(folder, "a.nii.gz", packed(nifti)), "NIfTI");
  const std::string nrrd = "encoding: raw\nendian: little\n";
  expect_counted(read(folder, "a.nrrd", nrrd_bytes(nrrd, data)), "NRRD");
  write_bytes(folder / "b.raw", data);
  expect_counted(read(folder, "b.nhdr", nrrd_bytes(nrrd + "data file: b.raw\n", "")), "NRRD");
  expect_counted(read(folder, "a.mha", meta_bytes("") + data), "MetaImage");
  std::vector<TiffPage> pages(5);
  for (std::size_t k = 0; k < 5; ++k) pages[k].pixels = data.substr(24 * k, 24);
  expect_counted(read(folder, "a.tif", tiff_bytes(pages)), "TIFF");
  expect_counted(read(folder, "a.inv3", inv3_bytes(4, 3, 5, data)), "InVesalius");
}

TEST(ReadLabels, OfEveryNumberTypeWithWholeValues) {
  const TempFolder folder;
  NiftiBytes nifti;
  nifti.datatype = 16, nifti.bitpix = 32;
  const std::vector<float> real(kLabels.begin(), kLabels.end());
  expect_counted(read(folder, "a.nii", nifti.header() + bytes_of_all(real)), "NIfTI");
  nifti.datatype = 1024, nifti.bitpix = 64;
  const std::vector<std::int64_t> whole(kLabels.begin(), kLabels.end());
  expect_counted(read(folder, "a.nii", nifti.header() + bytes_of_all(whole)), "NIfTI");
}

TEST(ReadLabels, NamesOfATotalSegmentatorFile) {
  const TempFolder folder;
  const std::string xml =
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?><CaretExtension><VolumeInformation Index=\"0\">"
      "<LabelTable><Label Key=\"5\" Red=\"0\" Green=\"1\" Blue=\"1\" Alpha=\"1\">"
      "<![CDATA[liver]]></Label></LabelTable></VolumeInformation></CaretExtension>";
  for (const bool big_endian : {false, true}) {
    NiftiBytes nifti;
    nifti.big_endian = big_endian;
    nifti.vox_offset = static_cast<float>(352 + 8 + xml.size());
    std::string header = nifti.header();
    header[348] = 1;
    header += bytes_of(static_cast<std::int32_t>(8 + xml.size()), big_endian) +
              bytes_of(std::int32_t{0}, big_endian) + xml;
    const std::string data = bytes_of_all(kLabels, big_endian);
    const LabelFile file = read(folder, "a.nii", header + data);
    EXPECT_EQ(find_segment(file.map.segments, "liver"), (Segment{"liver", 5, 0, {0, 255, 255}}));
    EXPECT_THAT(file.map.segments, SizeIs(59));
    EXPECT_THAT(file.warnings, SizeIs(0));
    header[352 + (big_endian ? 0 : 3)] = 0x7f;  // a size beyond the header
    const LabelFile broken = read(folder, "a.nii", header + data);
    EXPECT_THAT(broken.map.segments, SizeIs(59));
    EXPECT_THAT(broken.warnings, ElementsAre(HasSubstr("names of the labels are not read")));
  }
}

const std::string kSlicerGrid =
    "NRRD0004\ntype: uint8\nspace: left-posterior-superior\nencoding: raw\n"
    "space origin: (1,2,3)\n";

TEST(ReadLabels, SlicersLayersFirstOrLast) {
  const TempFolder folder;
  const std::string keys =
      "Segment0_ID:=Segment_1\nSegment0_Name:=left: "
      "hip\nSegment0_LabelValue:=2\nSegment0_Layer:=0\n"
      "Segment0_Color:=1 0 0\nSegment1_ID:=Segment_2\nSegment1_Name:=skin\n"
      "Segment1_LabelValue:=2\nSegment1_Layer:=1\n\n";
  const std::string directions = " (0,1,0) (-1,0,0) (0,0,2) ";
  const std::string first =
      kSlicerGrid + "dimension: 4\nsizes: 2 2 1 2\nkinds: list domain domain domain\n" +
      "space directions: none" + directions + "\n" + keys + std::string("\2\0\0\2\2\2\0\0", 8);
  const std::string last =
      kSlicerGrid + "dimension: 4\nsizes: 2 1 2 2\nkinds: domain domain domain list\n" +
      "space directions:" + directions + "none\n" + keys + std::string("\2\0\2\0\0\2\2\0", 8);
  for (const std::string& bytes : {first, last}) {
    const LabelFile file = read(folder, "a.seg.nrrd", bytes);
    EXPECT_THAT(file.map.size, ElementsAre(2, 1, 2));
    EXPECT_EQ(file.map.spacing, (Vec3{1, 1, 2}));
    EXPECT_EQ(file.map.to_world({1, 0, 0}), (Vec3{1, 3, 3}));
    EXPECT_THAT(file.map.layers, ElementsAre(ElementsAre(2, 0, 2, 0), ElementsAre(0, 2, 2, 0)));
    EXPECT_EQ(find_segment(file.map.segments, "left: hip"),
              (Segment{"left: hip", 2, 0, {255, 0, 0}}));
    EXPECT_EQ(find_segment(file.map.segments, "skin").layer, 1);
    EXPECT_REFUSED(find_segment(file.map.segments, "2"), HasSubstr("found 2"));
  }
}

TEST(ReadLabels, OlderSlicerFilesWithALayerPerSegment) {
  const TempFolder folder;
  const LabelFile file =
      read(folder, "a.seg.nrrd",
           kSlicerGrid + "dimension: 4\nsizes: 2 2 1 1\nkinds: list domain domain domain\n" +
               "space directions: none (1,0,0) (0,1,0) (0,0,1)\nSegment0_Name:=a\n" +
               "Segment1_Name:=b\n\n" + std::string("\1\0\1\1", 4));
  EXPECT_THAT(file.map.layers, ElementsAre(ElementsAre(1, 1), ElementsAre(0, 1)));
  EXPECT_EQ(find_segment(file.map.segments, "b").layer, 1);
}

TEST(ReadLabels, OfADicomSegmentation) {
  const TempFolder folder;
  write_bytes(folder / "seg" / "1.dcm", small_seg().bytes());
  const LabelFile file = read_label_map(folder / "seg" / "1.dcm");
  EXPECT_EQ(file.format, "DICOM");
  EXPECT_EQ(find_segment(file.map.segments, "bone").label, 1);
  EXPECT_EQ(read_label_map(folder / "seg").map.layers, file.map.layers);
  write_bytes(folder / "seg" / "2.dcm", small_seg().bytes());
  EXPECT_REFUSED(read_label_map(folder / "seg"),
                 AllOf(StartsWith((folder / "seg").string()), HasSubstr("found 2: 1.dcm, 2.dcm")));
  write_bytes(folder / "scan.dcm", SliceBytes{}.bytes());
  EXPECT_REFUSED(read_label_map(folder / "scan.dcm"), HasSubstr("a DICOM segmentation"));
}

std::string mask(const std::vector<std::int16_t>& values) {
  NiftiBytes nifti;
  nifti.dim = {3, 4, 2, 1, 1, 1, 1, 1};
  return nifti.header() + bytes_of_all(values);
}

TEST(ReadLabels, OfAFolderOfMasksNamedAfterTheirFiles) {
  const TempFolder folder;
  write_bytes(folder / "hip_left.nii.gz", packed(mask({0, 1, 1, 0, 0, 0, 0, 0})));
  write_bytes(folder / "liver.nii", mask({0, 0, 0, 0, 255, 0, 0, 0}));
  write_bytes(folder / "spleen.nii", mask({0, 0, 0, 0, 0, 0, 0, 0}));
  write_bytes(folder / "._liver.nii", "no mask");
  write_bytes(folder / "statistics.json", "{}");
  const LabelFile file = read_label_map(folder.path());
  EXPECT_EQ(file.format, "NIfTI masks");
  EXPECT_THAT(file.map.layers, ElementsAre(ElementsAre(0, 1, 1, 0, 2, 0, 0, 0)));
  ASSERT_THAT(file.map.segments, SizeIs(3));
  EXPECT_EQ(file.map.segments[0], (Segment{"hip_left", 1, 0, default_colour(1)}));
  EXPECT_EQ(file.map.segments[2].name, "spleen");
  EXPECT_THAT(file.warnings, Contains(HasSubstr("1 mask is empty: spleen")));
  EXPECT_NO_THROW(require_valid(file.map));
}

TEST(ReadLabels, OverlappingMasksStayWholeWithAWarning) {
  const TempFolder folder;
  write_bytes(folder / "a.nii", mask({1, 1, 1, 0, 0, 0, 0, 0}));
  write_bytes(folder / "b.nii", mask({0, 1, 1, 1, 0, 0, 0, 0}));
  write_bytes(folder / "c.nii", mask({0, 0, 0, 1, 1, 0, 0, 0}));
  const LabelFile file = read_label_map(folder.path());
  EXPECT_THAT(file.map.layers, ElementsAre(ElementsAre(1, 1, 1, 3, 3, 0, 0, 0),
                                           ElementsAre(0, 2, 2, 2, 0, 0, 0, 0)));
  EXPECT_THAT(file.warnings,
              Contains(HasSubstr("2 objects overlap others: each stays whole. The first is \"b\" "
                                 "with 2 voxels of \"a\"")));
}

TEST(ReadLabels, MasksThatWereCutOutOfOneGridAreReadTogether) {
  const TempFolder folder;
  write_bytes(folder / "a.nii", mask({1, 0, 0, 0, 0, 0, 0, 1}));
  NiftiBytes cut;  // two voxels along i, mirrored: the first is voxel 4 0 1 of the other
  cut.dim = {3, 2, 1, 1, 1, 1, 1, 1};
  cut.srow = {-0.5F, 0, 0, 12, 0, 1.25F, 0, 20, 0, 0, 2, 32};
  write_bytes(folder / "b.nii", cut.header() + bytes_of_all(std::vector<std::int16_t>{0, 9}));
  const LabelFile file = read_label_map(folder.path());
  EXPECT_THAT(file.map.size, ElementsAre(5, 2, 2));
  EXPECT_EQ(file.map.spacing, (Vec3{0.5, 1.25, 2}));
  std::vector<std::uint16_t> expected(20);
  expected[file.map.offset(0, 0, 0)] = expected[file.map.offset(3, 1, 0)] = 1;
  expected[file.map.offset(3, 0, 1)] = 2;
  EXPECT_THAT(file.warnings, ElementsAre(HasSubstr("put together on 5 x 2 x 2 voxels")));
  EXPECT_THAT(file.map.layers, ElementsAre(ElementsAreArray(expected)));
}

TEST(ReadLabels, MasksOfDifferentGridsAndOfSeveralObjectsAreRefused) {
  const TempFolder folder;
  write_bytes(folder / "a.nii", mask({1, 1, 1, 0, 0, 0, 0, 0}));
  NiftiBytes other;
  other.srow[0] = 0.75F;
  write_bytes(folder / "b.nii", other.header() + bytes_of_all(kLabels));
  EXPECT_REFUSED(read_label_map(folder.path()),
                 AllOf(StartsWith((folder / "b.nii").string()),
                       HasSubstr("expected the grid of a.nii, 4 x 2 x 1 voxels, found 4 x 3 x 5")));
  write_bytes(folder / "b.nii", mask({1, 2, 1, 0, 0, 0, 0, 0}));
  EXPECT_REFUSED(read_label_map(folder.path()),
                 HasSubstr("one object in each file of a folder, found the labels 1 and 2"));
  std::filesystem::remove(folder / "a.nii");  // one file may hold all objects
  EXPECT_THAT(read_label_map(folder.path()).map.segments, SizeIs(2));
}

TEST(ReadLabels, OfAFolderOfSlices) {
  const TempFolder folder;
  const std::string data = bytes_of_all(kLabels);
  for (std::size_t k = 0; k < 5; ++k) {
    TiffPage page;
    page.pixels = data.substr(24 * k, 24);
    write_bytes(folder / ("s" + std::to_string(9 + k) + ".tif"), tiff_bytes({page}));
  }
  const LabelFile file = read_label_map(folder.path());
  expect_counted(file, "TIFF slices");
  VoxelGrid scan;
  scan.size = {4, 3, 5};
  scan.spacing = {0.5, 0.5, 2};
  scan.origin = {1, 2, 3};
  const LabelFile placed = read_label_map(folder.path(), {{}, [&] { return scan; }});
  EXPECT_EQ(placed.map.to_world({0, 0, 0}), scan.origin);
  EXPECT_EQ(placed.map.spacing, scan.spacing);
  EXPECT_THAT(placed.warnings, ElementsAre(HasSubstr("its place is taken")));
  scan.size = {4, 3, 6};
  EXPECT_EQ(read_label_map(folder.path(), {{}, [&] { return scan; }}).map.origin, (Vec3{}));
}

/// A spacing that is given takes the place of what pictures lack, and of what files state.
TEST(ReadLabels, TakeTheSpacingThatIsGiven) {
  const TempFolder folder;
  const std::string data = bytes_of_all(kLabels);
  const LabelOptions how{.spacing = Vec3{3, 4, 5}};
  std::vector<TiffPage> pages(5);
  for (std::size_t k = 0; k < 5; ++k) pages[k].pixels = data.substr(24 * k, 24);
  write_bytes(folder / "a.tif", tiff_bytes(pages));
  write_bytes(folder / "a.nii", NiftiBytes{}.header() + data);
  write_bytes(folder / "a.nrrd", nrrd_bytes("encoding: raw\nendian: little\n", data));
  for (const char* name : {"a.tif", "a.nii", "a.nrrd"}) {
    const LabelFile file = read_label_map(folder / name, how);
    EXPECT_EQ(file.map.spacing, *how.spacing) << name;
    EXPECT_THAT(file.warnings, testing::Each(testing::Not(HasSubstr("1 mm assumed")))) << name;
  }
  EXPECT_REFUSED(read_label_map(folder / "a.tif", {.spacing = Vec3{1, 0, 1}}),
                 HasSubstr("spacing"));
}

/// Labels and probabilities of sheared grids, and masks of a folder, come onto an orthogonal one.
TEST(ReadLabels, AreResampledFromShearedGrids) {
  const TempFolder folder;
  const std::string head =
      "NRRD0004\ntype: uint8\ndimension: 3\nsizes: 6 5 4\n"
      "space: left-posterior-superior\nspace directions: (1,0,0) (0.4,1,0) (0,0,1)\n"
      "encoding: raw\n\n";
  std::string voxels;
  for (int n = 0; n < 6 * 5 * 4; ++n) voxels += static_cast<char>(n % 6 < 3 ? 1 : 0);
  write_bytes(folder / "masks/left.nrrd", head + voxels);
  write_bytes(folder / "masks/right.nrrd", head + voxels);
  const std::string file = folder / "masks/left.nrrd";
  EXPECT_REFUSED(read_label_map(file), HasSubstr("--resample"));
  const LabelOptions how{.resample = true};
  const LabelFile one = read_label_map(file, how);
  EXPECT_THAT(one.map.size, ElementsAre(8, 5, 4)) << "sheared by 1.6 voxels";
  EXPECT_THAT(one.warnings, ElementsAre(HasSubstr("nearest")));
  EXPECT_NO_THROW(require_valid(one.map));
  const auto marked = std::count(one.map.layers[0].begin(), one.map.layers[0].end(), 1);
  EXPECT_EQ(marked, 3 * 5 * 4) << "each row has shifted whole voxels";
  EXPECT_THAT(read_label_map(folder / "masks", how).map.segments, SizeIs(2));
  const ProbabilityFile probable = read_probabilities({file}, how);
  EXPECT_EQ(probable.probabilities.size, one.map.size);
  EXPECT_EQ(probable.probabilities.layers[0].size(), one.map.layers[0].size());
}

const std::string kColours("\0\0\0\xff\0\0\0\xff\0", 9);  // black, red, green

/// Pixels 0, 1, 2, 1.
std::string png_with_palette(const std::string& palette) {
  PngBytes png{.width = 2, .height = 2, .bits = 2, .color = 3, .palette = palette};
  png.lines = {std::string("\0\x10", 2), std::string("\0\x90", 2)};
  return png.bytes();
}

std::string tiff_with_palette(std::uint16_t red) {
  TiffPage page{2, 2, 4, 1, 1, 3, 0, "", "\x01\x21"};
  page.colours = std::vector<std::uint16_t>(48);
  page.colours[1] = red;          // of 1
  page.colours[16 + 2] = 0xffff;  // green of 2
  return tiff_bytes({page});
}

std::string bmp_with_palette(const std::string& more) {
  BmpBytes bmp{.width = 2, .height = -2, .bits = 4, .colors = 3};
  bmp.palette = std::string("\0\0\0\0\0\0\xff\0\0\xff\0", 11) + more;
  bmp.pixels = std::string("\x01\0\0\0\x21\0\0\0", 8);
  return bmp.bytes();
}

TEST(ReadLabels, OfPicturesWithATableOfColoursTheIndices) {
  const TempFolder folder;
  const std::string tiff = tiff_with_palette(0xffff), bmp = bmp_with_palette(std::string(1, '\0'));
  const std::vector<std::pair<std::string, std::string>> pictures{
      {"png", png_with_palette(kColours)}, {"tif", tiff}, {"bmp", bmp}};
  for (const auto& [format, bytes] : pictures) {
    for (const char* slice : {"/1.", "/2."}) write_bytes(folder / (format + slice + format), bytes);
    const LabelFile file = read_label_map(folder / format);
    EXPECT_THAT(file.map.layers, ElementsAre(ElementsAre(0, 1, 2, 1, 0, 1, 2, 1))) << format;
    ASSERT_THAT(file.map.segments, SizeIs(2)) << format;
    EXPECT_THAT(file.map.segments[0].colour, ElementsAre(255, 0, 0)) << format;
    EXPECT_THAT(file.map.segments[1].colour, ElementsAre(0, 255, 0)) << format;
  }
}

TEST(ReadLabels, TablesOfColoursMustBeAlikeAndBeginWithBlack) {
  const TempFolder folder;
  const std::string white(9, '\xff');
  write_bytes(folder / "png/1.png", png_with_palette(kColours));
  write_bytes(folder / "png/2.png", png_with_palette(white));
  write_bytes(folder / "tif/1.tif", tiff_with_palette(0xffff));
  write_bytes(folder / "tif/2.tif", tiff_with_palette(0));
  for (const char* format : {"png", "tif"}) {
    EXPECT_REFUSED(read_label_map(folder / format),
                   AllOf(HasSubstr("2."), HasSubstr("expected the table of colours of the first")));
  }
  write_bytes(folder / "png/1.png", png_with_palette(white));
  EXPECT_THAT(read_label_map(folder / "png").warnings, Contains(HasSubstr("it is not black")));
}

TEST(ReadLabels, OfPicturesNoneThatAreLossy) {
  const TempFolder folder;
  for (const char* name : {"1.jpg", "2.jpg"}) write_bytes(folder / name, flat_jpeg(8, 3));
  EXPECT_REFUSED(read_label_map(folder.path()), HasSubstr("1.jpg: expected labels as .png"));
}

TEST(ReadLabels, OfTiffNumbersThatSinglePrecisionRounds) {
  const TempFolder folder;
  TiffPage page{2, 1, 32, 1, 1, 1, 0, "", ""};
  page.pixels = bytes_of_all(std::vector<std::uint32_t>{614454277, 614454278});
  const LabelFile file = read(folder, "a.tif", tiff_bytes({page}));
  EXPECT_THAT(file.map.layers, ElementsAre(ElementsAre(1, 2)));
  EXPECT_EQ(file.map.segments[1].number_in_file, 614454278);
}

TEST(ReadLabels, ADirectoryOfDicomLabelsAloneIsALabelFile) {
  const TempFolder folder;
  write_bytes(folder / "a/1.dcm", small_seg().bytes());
  EXPECT_TRUE(is_label_file(folder / "a"));
  EXPECT_FALSE(is_label_file(folder.path() / "b"));
  write_bytes(folder / "a/2.dcm", SliceBytes{}.bytes());
  EXPECT_FALSE(is_label_file(folder / "a"));
  write_bytes(folder / "c/a.txt", "x");
  EXPECT_FALSE(is_label_file(folder / "c"));
}

TEST(ReadLabels, OfADicomFolderTheOneFileThatHoldsLabels) {
  const TempFolder folder;
  write_bytes(folder / "1.dcm", SliceBytes{}.bytes());
  EXPECT_REFUSED(read_label_map(folder.path()), HasSubstr("found 1 DICOM files of other kinds"));
  write_bytes(folder / "2.dcm", small_seg().bytes());
  EXPECT_EQ(find_segment(read_label_map(folder.path()).map.segments, "bone").label, 1);
}

TEST(ReadLabels, AFolderWithoutLabelsSaysWhatIsThere) {
  const TempFolder folder;
  write_bytes(folder / "notes.txt", "x");
  std::filesystem::create_directory(folder / "masks");
  EXPECT_REFUSED(read_label_map(folder.path()), HasSubstr("found notes.txt, the folder masks"));
}

TEST(ReadLabels, RefusesWhatIsNoLabelMap) {
  const TempFolder folder;
  NiftiBytes nifti;
  nifti.dim = {4, 4, 3, 5, 2, 1, 1, 1};
  const std::string twice = bytes_of_all(kLabels) + bytes_of_all(kLabels);
  EXPECT_REFUSED(read(folder, "a.nii", nifti.header() + twice), HasSubstr("found 2 volumes"));
  EXPECT_REFUSED(
      read(folder, "a.nii", NiftiBytes{}.header() + bytes_of_all(ramp<std::int16_t>(60))),
      HasSubstr("found -40 at voxel 0 0 0"));
  EXPECT_REFUSED(read(folder, "a.txt", "1 bone"), HasSubstr("expected .nii"));
  EXPECT_REFUSED(read_label_map(folder / "none.nii"), HasSubstr("no such file"));
  EXPECT_REFUSED(read(folder, "a.nii", NiftiBytes{}.header() + "xx"), HasSubstr("120 bytes"));
}

// --- Probabilities -----------------------------------------------------------------------------

std::string share_nifti(const std::vector<float>& values, std::int16_t volumes,
                        bool fifth = false) {
  NiftiBytes nifti;
  nifti.datatype = 16, nifti.bitpix = 32;
  nifti.dim = {3, 2, 1, 2, 1, 1, 1, 1};
  if (volumes > 1) nifti.dim = {4, 2, 1, 2, volumes, 1, 1, 1};
  if (fifth) nifti.dim = {5, 2, 1, 2, 1, volumes, 1, 1};
  return nifti.header() + bytes_of_all(values);
}

TEST(ReadProbabilities, OfFourDimensions) {
  const TempFolder folder;
  for (const bool fifth : {false, true}) {
    write_bytes(folder / "a.nii", share_nifti({0, 0.25, 0.5, 1, 1, 0.75, 0.5, 0.25}, 2, fifth));
    const Probabilities p = read_probabilities({folder / "a.nii"}).probabilities;
    EXPECT_THAT(p.layers,
                ElementsAre(ElementsAre(0, 0.25f, 0.5f, 1), ElementsAre(1, 0.75f, 0.5f, 0.25f)));
    ASSERT_THAT(p.segments, SizeIs(2));
    EXPECT_EQ(p.segments[1], (Segment{"label 2", 2, 1, default_colour(2)}));
  }
  write_bytes(folder / "a.nrrd",
              "NRRD0004\ntype: float\nspace: RAS\nencoding: raw\nendian: little\ndimension: 4\n"
              "sizes: 2 2 1 2\nspace directions: none (1,0,0) (0,1,0) (0,0,1)\n"
              "Segment0_Name:=bone\nSegment1_Name:=skin\n\n" +
                  bytes_of_all(std::vector<float>{0, 1, 0.25, 0.75, 0.5, 0.5, 1, 0}));
  const Probabilities p = read_probabilities({folder / "a.nrrd"}).probabilities;
  EXPECT_THAT(p.layers[1], ElementsAre(1, 0.75f, 0.5f, 0));
  EXPECT_EQ(find_segment(p.segments, "skin").layer, 1);
}

TEST(ReadProbabilities, OfANetworkLeaveOutTheBackground) {
  const TempFolder folder;
  const std::vector<float> first{1, 0.5, 0.25, 0}, second{0, 0.25, 0.25, 1}, third{0, 0.25, 0.5, 0};
  std::vector<float> all = first;
  all.insert(all.end(), second.begin(), second.end());
  all.insert(all.end(), third.begin(), third.end());
  all[5] += 0.002f;  // as half precision rounds
  write_bytes(folder / "a.nii", share_nifti(all, 3));
  const ProbabilityFile file = read_probabilities({folder / "a.nii"});
  EXPECT_THAT(file.warnings, Contains(HasSubstr("first of 3 channels")));
  ASSERT_THAT(file.probabilities.layers, SizeIs(2));
  EXPECT_EQ(file.probabilities.layers[1], third);
  EXPECT_EQ(file.probabilities.segments[0], (Segment{"label 1", 1, 0, default_colour(1)}));
  // A file per object: each of them is one.
  write_bytes(folder / "b.nii", share_nifti(first, 1));
  write_bytes(folder / "c.nii", share_nifti({0, 0.5, 0.75, 1}, 1));
  const ProbabilityFile each = read_probabilities({folder / "b.nii", folder / "c.nii"});
  EXPECT_THAT(each.probabilities.layers, SizeIs(2));
  EXPECT_THAT(each.warnings, Not(Contains(HasSubstr("channels"))));
}

TEST(ReadProbabilities, OfOneVolumeEach) {
  const TempFolder folder;
  write_bytes(folder / "left hip.nii.gz", packed(share_nifti({0, 0.25, 0.5, 1}, 1)));
  write_bytes(folder / "skin.nii", share_nifti({1, 0.75, 0.5, 0}, 1));
  const Probabilities p =
      read_probabilities({folder / "left hip.nii.gz", folder / "skin.nii"}).probabilities;
  EXPECT_THAT(p.size, ElementsAre(2, 1, 2));
  EXPECT_EQ(p.spacing, (Vec3{0.5, 1.25, 2}));
  ASSERT_THAT(p.layers, SizeIs(2));
  EXPECT_EQ(find_segment(p.segments, "skin").layer, 1);
  EXPECT_EQ(find_segment(p.segments, "left hip").layer, 0);
}

TEST(ReadProbabilities, OfADicomSegmentation) {
  const TempFolder folder;
  write_bytes(folder / "a.dcm", small_seg().bytes());
  EXPECT_EQ(read_probabilities({folder / "a.dcm"}).probabilities.segments[0].name, "bone");
}

TEST(ReadProbabilities, RefusesOtherValuesAndGridsThatDiffer) {
  const TempFolder folder;
  const std::string good = share_nifti({0, 0.25, 0.5, 1}, 1);
  write_bytes(folder / "a.nii", good);
  const auto with_second = [&](const std::string& bytes) {
    write_bytes(folder / "b.nii", bytes);
    return read_probabilities({folder / "a.nii", folder / "b.nii"});
  };
  EXPECT_NO_THROW(with_second(good));
  EXPECT_REFUSED(with_second(share_nifti({0, 0.25, 0.5, 2}, 1)),
                 AllOf(HasSubstr("b.nii: expected probabilities"), HasSubstr("found 2")));
  std::string moved = good;
  moved.replace(292, 4, bytes_of(10.5f));
  EXPECT_REFUSED(with_second(moved), HasSubstr("lies 1 voxels away"));
  std::string larger = good;
  larger.replace(44, 2, bytes_of(std::int16_t{2}));
  EXPECT_REFUSED(with_second(larger + std::string(16, '\0')), HasSubstr("found 2 x 2 x 2 voxels"));
  EXPECT_REFUSED(with_second(share_nifti(std::vector<float>(8), 2)), HasSubstr("found 2"));
  EXPECT_REFUSED(read_probabilities({}), HasSubstr("at least one file"));
}

}  // namespace
}  // namespace mesamis
