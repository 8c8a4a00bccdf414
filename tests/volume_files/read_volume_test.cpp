// SPDX-License-Identifier: Apache-2.0
#include "mesamis/volume_files/read_volume.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "mesamis/base/error.h"
#include "mesamis/files/sha256.h"
#include "support/expect_near.h"
#include "support/read_scan.h"
#include "support/scan_bytes.h"
#include "support/temp_folder.h"
#include "support/throws.h"

namespace mesamis {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

TEST(ReadVolume, RefusesAHeaderThatPromisesMoreThanTheFileHolds) {
  const TempFolder folder;
  const double before = peak_mb();
  const std::string few(100, 'x');
  NiftiBytes huge;
  huge.dim = {3, 5000, 5000, 5000, 1, 1, 1, 1};
  EXPECT_THAT(complaint(folder, "a.nii", huge.header() + few), HasSubstr("expected 250000000000"));
  EXPECT_THAT(complaint(folder, "a.nii.gz", packed(huge.header() + few)), HasSubstr("at most"));
  const std::string sizes = "dimension: 3\nsizes: 60000 60000 60000\ntype: double\n";
  EXPECT_THAT(
      complaint(folder, "a.nrrd", "NRRD0004\n" + sizes + "encoding: raw\nendian: little\n\n" + few),
      HasSubstr("60000 x 60000 x 60000"));
  EXPECT_THAT(complaint(folder, "b.nrrd", "NRRD0004\n" + sizes + "encoding: ascii\n\n1 2 3"),
              HasSubstr("60000 x 60000 x 60000"));
  EXPECT_THAT(complaint(folder, "a.mha",
                        "NDims = 3\nDimSize = 60000 60000 60000\nElementType = MET_DOUBLE\n"
                        "ElementDataFile = LOCAL\n" +
                            few),
              HasSubstr("60000 x 60000 x 60000"));
  EXPECT_THAT(complaint(folder, "a.inv3", packed(inv3_bytes(5000, 5000, 5000, few))),
              HasSubstr("found 100"));
  TiffPage page;
  page.width = page.height = 60000;
  page.pixels = few;
  EXPECT_THAT(complaint(folder, "a.tif", tiff_bytes({page, page})), HasSubstr("found a file of"));
  // More voxels than an index can count.
  EXPECT_THAT(complaint(folder, "c.nrrd",
                        "NRRD0004\ntype: short\ndimension: 3\nsizes: 9223372036854775807 9 9\n"
                        "encoding: raw\nendian: little\n\n"),
              HasSubstr("9223372036854775807"));
  EXPECT_THAT(complaint(folder, "d.nrrd",
                        "NRRD0004\ntype: short\ndimension: 3\n"
                        "sizes: 2147483647 2147483647 2147483647\nencoding: raw\n"
                        "endian: little\n\n"),
              HasSubstr("more voxels"));
  EXPECT_LT(peak_mb() - before, 64);
}

// What a gzip'd file can unpack to is not known beforehand: memory may grow only with what is
// there.
TEST(ReadVolume, GrowsWithTheDataAndNotWithTheHeader) {
  const TempFolder folder;
  NiftiBytes nifti;
  nifti.dim = {3, 1000, 1000, 400, 1, 1, 1, 1};  // 1.6 GB of floats
  std::string noise(4'000'000, '\0');
  std::uint32_t state = 1;
  for (char& c : noise) c = static_cast<char>((state = state * 1664525 + 1013904223) >> 24);
  const std::string bytes = packed(nifti.header() + noise);
  const double before = peak_mb();
  EXPECT_THAT(complaint(folder, "a.nii.gz", bytes), HasSubstr("found 4000000"));
  EXPECT_LT(peak_mb() - before, 400);  // the address sanitizer marks what is reserved: 200
}

TEST(ReadVolume, RefusesTruncatedAndBrokenData) {
  const TempFolder folder;
  const std::string data = bytes_of_all(kRamp);
  const std::string nifti = NiftiBytes{}.header() + data;
  EXPECT_THAT(complaint(folder, "a.nii", nifti.substr(0, nifti.size() - 1)),
              HasSubstr("found 119"));
  const std::string zipped = packed(nifti);
  EXPECT_THAT(complaint(folder, "a.nii.gz", zipped.substr(0, zipped.size() / 2)),
              HasSubstr("cut off"));
  std::string broken = zipped;
  broken[broken.size() - 6] ^= 0x55;  // the checksum
  EXPECT_THAT(complaint(folder, "b.nii.gz", broken + "x"),
              testing::AnyOf(IsEmpty(), HasSubstr("broken")));
  EXPECT_THAT(complaint(folder, "a.nrrd", nrrd_bytes("encoding: raw\nendian: little\n", "123")),
              HasSubstr("found 3"));
  EXPECT_THAT(
      complaint(folder, "b.nrrd", nrrd_bytes("encoding: gzip\nendian: little\n", "no gzip here")),
      HasSubstr("broken"));
  EXPECT_THAT(complaint(folder, "c.nrrd", nrrd_bytes("encoding: ascii\n", "1 2 3 4")),
              HasSubstr("expected 119 bytes"));
  std::string text;
  for (int n = 0; n < 60; ++n) text += n == 30 ? "many " : "12345 ";
  EXPECT_THAT(complaint(folder, "d.nrrd", nrrd_bytes("encoding: ascii\n", text)),
              HasSubstr("sample 30, found \"many\""));
  EXPECT_THAT(complaint(folder, "a.mha", meta_bytes("") + "123"), HasSubstr("found 3"));
  EXPECT_THAT(complaint(folder, "a.inv3", inv3_bytes(4, 3, 5, data).substr(0, 600)),
              HasSubstr("main.plist"));
}

TEST(ReadVolume, HandsOnUnknownSamplesAndThinVolumesThatTheGateRefuses) {
  const TempFolder folder;
  NiftiBytes nifti;
  nifti.datatype = 16;
  std::vector<float> values(60, 1);
  const auto read_values = [&] {
    return read(folder, "a.nii", nifti.header() + bytes_of_all(values)).volume;
  };
  EXPECT_THROW(require_usable(read_values()), InputError);  // constant
  values[7] = 2;
  EXPECT_NO_THROW(require_usable(read_values()));
  values[9] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_TRUE(std::isnan(read_values().samples[9]));
  EXPECT_THROW(require_usable(read_values()), InputError);
  nifti.dim = {3, 12, 5, 1, 1, 1, 1, 1};
  values[9] = 3;
  EXPECT_EQ(read_values().size[2], 1);
  EXPECT_THROW(require_usable(read_values()), InputError);
}

TEST(ReadVolume, RefusesWhatIsNoScanAtAll) {
  const TempFolder folder;
  EXPECT_THAT(complaint(folder / "nowhere.nii"), HasSubstr("no such file"));
  EXPECT_THAT(complaint(folder.path()), HasSubstr("found none"));
  EXPECT_THAT(complaint(folder, "notes.txt", "a scan of my head"), HasSubstr("found none of them"));
  EXPECT_THAT(complaint(folder, "empty", ""), HasSubstr("found none of them"));
  EXPECT_THAT(complaint(folder, "a.img", std::string(5000, '\0')), HasSubstr("found none of them"));
  for (const char* name :
       {"a.nii", "a.nii.gz", "a.nrrd", "a.nhdr", "a.mha", "a.mhd", "a.tif", "a.tiff", "a.inv3"}) {
    EXPECT_NE(complaint(folder, name, "a scan of my head\nand its second line\n"), "") << name;
    EXPECT_NE(complaint(folder, name, std::string(3'000'000, 'x')), "") << name;
    EXPECT_NE(complaint(folder, name, std::string(10'000, '\0')), "") << name;
    EXPECT_NE(complaint(folder, name, ""), "") << name;
  }
  EXPECT_NE(complaint("/dev/null"), "");
}

TEST(ReadGrid, IsThatOfTheVolumeWithoutItsSamples) {
  const TempFolder folder;
  NiftiBytes nifti;
  nifti.dim = {3, 4, 5, 6, 1, 1, 1, 1};
  write_bytes(folder / "a.nii", nifti.header() + std::string(4 * 5 * 6 * 8, 'x'));
  const VoxelGrid grid = read_grid(folder / "a.nii");
  const Volume volume = read_volume(folder / "a.nii").volume;
  EXPECT_EQ(grid.size, volume.size);
  EXPECT_EQ(grid.spacing, volume.spacing);
  EXPECT_EQ(grid.origin, volume.origin);
  ReadOptions options;
  options.spacing = Vec3{1, 2, 3};
  EXPECT_EQ(read_grid(folder / "a.nii", options).spacing, (Vec3{1, 2, 3}));
  EXPECT_THROW(read_grid(folder / "none.nii"), InputError);
}

TEST(ListVolumes, NamesEveryVolumeAndWhatIsWrongWithIt) {
  const TempFolder folder;
  write_bytes(folder / "a.nii", NiftiBytes{}.header() + bytes_of_all(kRamp));
  write_bytes(folder / "b.nrrd", "NRRD0004\nnonsense\n");
  write_bytes(folder / "c.txt", "notes");
  const auto all = list_volumes(folder.path());
  ASSERT_EQ(all.size(), 2u);
  EXPECT_EQ(all[0].format, "NIfTI");
  EXPECT_EQ(all[0].size, (std::array<Index, 3>{4, 3, 5}));
  expect_near(all[0].spacing, {0.5, 1.25, 2});
  EXPECT_EQ(all[0].problem, "");
  EXPECT_EQ(all[1].description, "b.nrrd");
  EXPECT_THAT(all[1].problem, HasSubstr("nonsense"));
  EXPECT_EQ(list_volumes(folder / "a.nii").size(), 1u);
  EXPECT_THROW(list_volumes(folder / "c.txt"), InputError);
  EXPECT_THROW(list_volumes(folder / "nowhere"), InputError);
}

std::vector<std::string> names_of(const VolumeFile& volume) {
  std::vector<std::string> names;
  for (const ReadFile& file : volume.files) names.push_back(file.path.filename());
  return names;
}

/// The header alone would not tell which voxels a report is about.
TEST(ReadVolume, ListsTheFilesThatItRead) {
  const TempFolder folder;
  write_bytes(folder / "a.raw", std::string(2 * 2 * 2, 'x'));
  write_bytes(folder / "a.nhdr",
              "NRRD0004\ntype: uint8\ndimension: 3\nsizes: 2 2 2\nencoding: raw\n"
              "spacings: 1 1 1\ndata file: a.raw\n\n");
  const VolumeFile detached = read_volume(folder / "a.nhdr");
  EXPECT_EQ(names_of(detached), (std::vector<std::string>{"a.nhdr", "a.raw"}));
  write_bytes(folder / "a.raw", std::string(2 * 2 * 2, 'y') + "z");
  EXPECT_REFUSED(sha256(detached.files), HasSubstr("a.raw: expected a file that stays"));
}

/// A folder that holds neither DICOM nor slices says what it holds.
TEST(ReadVolume, AFolderSaysWhatItHolds) {
  const TempFolder folder;
  EXPECT_THAT(complaint(folder.path()), testing::EndsWith("found none"));
  write_bytes(folder / "notes.txt", "hello");
  EXPECT_THAT(complaint(folder.path()), testing::HasSubstr("found none but notes.txt"));
  write_bytes(folder / "ct.nii.gz", "x");
  EXPECT_THAT(complaint(folder.path()), testing::HasSubstr("name the file itself, as "));
  write_bytes(folder / "seg.nrrd", "x");
  EXPECT_THAT(complaint(folder.path()), testing::HasSubstr("ct.nii.gz, notes.txt, seg.nrrd"));
}

}  // namespace
}  // namespace mesamis
