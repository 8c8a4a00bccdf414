// SPDX-License-Identifier: Apache-2.0
// Small files that claim much memory, and what is asked before samples are read.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <functional>

#include "mesamis/volume_files/read_volume.h"
#include "support/as_nobody.h"
#include "support/dicom_bytes.h"
#include "support/picture_bytes.h"
#include "support/read_scan.h"
#include "support/throws.h"

namespace mesamis {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;

/// NIfTI of 200 x 200 x 100 equal voxels: 4 MB that become 16.
std::string large_nifti() {
  NiftiBytes nifti;
  nifti.dim = {3, 200, 200, 100, 1, 1, 1, 1};
  nifti.datatype = 2, nifti.bitpix = 8;
  return nifti.header() + std::string(4'000'000, '\1');
}

ReadOptions within(double memory_gb) {
  ReadOptions options;
  options.limits.memory_gb = memory_gb;
  return options;
}

TEST(GreedyScans, AreRefusedBeforeTheyTakeMoreThanIsAllowed) {
  const TempFolder folder;
  SliceBytes slice;
  slice.columns = slice.rows = 1000;
  slice.pixels.assign(1'000'000, 7);
  slice.coding = DicomCoding::kDeflated;
  const std::pair<const char*, std::string> files[] = {
      {"a.nii.gz", packed(large_nifti())},
      {"a.nrrd", "NRRD0004\ntype: uchar\ndimension: 3\nsizes: 200 200 100\nencoding: gzip\n\n" +
                     packed(std::string(4'000'000, '\1'))},
      {"a.mha",
       "NDims = 3\nDimSize = 200 200 100\nElementType = MET_UCHAR\nCompressedData = True\n"
       "ElementDataFile = LOCAL\n" +
           packed(std::string(4'000'000, '\1'), 15)},
      {"a.dcm", slice.bytes()},
  };
  for (const auto& [name, bytes] : files) {
    EXPECT_LT(bytes.size(), 20'000u) << name;
    write_bytes(folder / name, bytes);
  }
  slice.position = {0, 0, 1};
  write_bytes(folder / "b.dcm", slice.bytes());
  for (const auto& [name, bytes] : files) {
    const double needed = std::string(name) == "a.dcm" ? 0.012 : 0.0165;
    EXPECT_REFUSED(read_volume(folder / name, within(0.002)),
                   AllOf(HasSubstr(name), HasSubstr("memory: expected")));
    EXPECT_NO_THROW(read_volume(folder / name, within(needed))) << name;
  }
}

TEST(GreedyScans, OfPicturesAreRefusedToo) {
  const TempFolder folder;
  const auto refused = [](const fs::path& path) {
    EXPECT_REFUSED(read_volume(path, within(0.001)), HasSubstr("memory: expected"));
    EXPECT_NO_THROW(read_volume(path, within(0.1)));
  };
  const std::string grey(700 * 700, '\x09');
  write_bytes(folder / "a.png", png_bytes(700, 700, grey));
  BmpBytes bmp;
  bmp.width = bmp.height = 700;
  bmp.palette = grey_palette();
  bmp.pixels = grey;
  write_bytes(folder / "a.bmp", bmp.bytes());
  refused(folder / "a.bmp");
  refused(folder / "a.png");
  write_bytes(folder / "stack/1.png", png_bytes(700, 700, grey));
  write_bytes(folder / "stack/2.png", png_bytes(700, 700, grey));
  refused(folder / "stack");
}

/// The grid is told, with the spacing that was asked for, before a sample is read.
TEST(GreedyScans, TheGridIsToldBeforeTheSamplesAreRead) {
  const TempFolder folder;
  const std::string whole = large_nifti();
  write_bytes(folder / "a.nii", whole.substr(0, whole.size() - 1));
  ReadOptions options;
  options.spacing = Vec3{1, 2, 3};
  std::vector<VoxelGrid> told;
  options.on_grid = [&told](const VoxelGrid& grid) { told.push_back(grid); };
  EXPECT_REFUSED(read_volume(folder / "a.nii", options), HasSubstr("expected 4000000 bytes"));
  ASSERT_EQ(told.size(), 1u);
  EXPECT_EQ(told[0].size, (std::array<Index, 3>{200, 200, 100}));
  EXPECT_EQ(told[0].spacing, (Vec3{1, 2, 3}));
  options.on_grid = [](const VoxelGrid&) { throw InputError("no room"); };
  EXPECT_REFUSED(read_volume(folder / "a.nii", options), HasSubstr("a.nii: no room"));
}

TEST(GreedyScans, TheGridOfSlicesIsToldOnce) {
  const TempFolder folder;
  SliceBytes slice;
  for (int n = 0; n < 3; ++n) {
    slice.position = {0, 0, 2.0 * n};
    write_bytes(folder / ("dicom/" + std::to_string(n)), slice.bytes());
    write_bytes(folder / ("png/" + std::to_string(n) + ".png"),
                png_bytes(4, 3, std::string(12, '\x09')));
  }
  for (const char* name : {"dicom", "png"}) {
    std::vector<VoxelGrid> told;
    ReadOptions options;
    options.on_grid = [&told](const VoxelGrid& grid) { told.push_back(grid); };
    const VolumeFile file = read_volume(folder / name, options);
    ASSERT_EQ(told.size(), 1u) << name;
    EXPECT_EQ(told[0].size, file.volume.size);
    EXPECT_EQ(told[0].spacing, file.volume.spacing);
  }
}

// --- Other files than the one that is named ---------------------------------------------------

TEST(ForeignFiles, AHeaderMayNotNameDataOutsideOfItsFolder) {
  const TempFolder folder;
  write_bytes(folder / "secret", bytes_of_all(kRamp));
  const std::string nrrd =
      "NRRD0004\ntype: short\ndimension: 3\nsizes: 4 3 5\nencoding: raw\nendian: little\n";
  const std::string meta = "NDims = 3\nDimSize = 4 3 5\nElementType = MET_SHORT\n";
  for (const std::string& name : {std::string("../secret"), (folder / "secret").string()}) {
    write_bytes(folder / "in/a.nhdr", nrrd + "data file: " + name + "\n");
    write_bytes(folder / "in/a.mhd", meta + "ElementDataFile = " + name + "\n");
    for (const char* header : {"in/a.nhdr", "in/a.mhd"}) {
      EXPECT_REFUSED(read_volume(folder / header),
                     AllOf(HasSubstr("in the header's folder"), HasSubstr("--allow-outside")));
      EXPECT_THAT(list_volumes(folder / header).at(0).problem, HasSubstr("the header's folder"));
      ReadOptions options;
      options.limits.allow_outside = true;
      expect_ramp(read_volume(folder / header, options).volume);
    }
  }
}

TEST(ForeignFiles, AFileOfADicomFolderThatCannotBeOpenedIsLeftOutWithAWarning) {
  const AsNobody user;
  const TempFolder folder;
  SliceBytes slice;
  for (int n = 0; n < 3; ++n) {
    slice.position = {0, 0, 2.0 * n};
    write_bytes(folder / std::to_string(n), slice.bytes());
  }
  write_bytes(folder / "stray", slice.bytes());
  fs::permissions(folder / "stray", fs::perms::none);
  const VolumeFile file = read_volume(folder.path());
  EXPECT_EQ(file.volume.size[2], 3);
  EXPECT_THAT(file.warnings,
              testing::Contains(
                  HasSubstr("1 file left out that cannot be read, the first stray: permission")));
  EXPECT_EQ(list_volumes(folder.path()).size(), 1u);
  EXPECT_REFUSED(read_volume(folder / "stray"), HasSubstr("cannot be read: permission denied"));
}

TEST(ForeignFiles, PipesLinksInALoopAndLongNamesAreRefusedInOneLine) {
  const TempFolder folder;
  ASSERT_EQ(mkfifo((folder / "a.nii").c_str(), 0600), 0);
  fs::create_symlink("b.nii", folder / "b.nii");
  EXPECT_THAT(complaint(folder / "a.nii"), HasSubstr("found neither"));
  EXPECT_THAT(complaint(folder / "b.nii"), HasSubstr("cannot be read: too many levels"));
  EXPECT_THAT(complaint(folder / (std::string(300, 'a') + ".nii")), HasSubstr("name too long"));
  write_bytes(
      folder / "c.nhdr",
      "NRRD0004\ntype: uchar\ndimension: 3\nsizes: 2 2 2\nencoding: raw\ndata file: a.nii\n");
  EXPECT_THAT(complaint(folder / "c.nhdr"), HasSubstr("found neither"));
}

}  // namespace
}  // namespace mesamis
