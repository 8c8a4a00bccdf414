// SPDX-License-Identifier: Apache-2.0
#include "mesamis/label_files/mask_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/scan_bytes.h"
#include "support/temp_folder.h"
#include "support/throws.h"
#include "support/wide_budget.h"

namespace mesamis {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

TEST(MaskFolder, ObjectsAreNamedAfterTheirFiles) {
  EXPECT_EQ(object_name("/a/hip_left.nii.gz"), "hip_left");
  EXPECT_EQ(object_name("vertebra.T12.nii.gz"), "vertebra.T12");
  EXPECT_EQ(object_name("a.seg.nrrd"), "a");
  EXPECT_EQ(object_name("a.NII.GZ"), "a");
  EXPECT_EQ(object_name("a.mha"), "a");
}

TEST(MaskFolder, HoldsVolumesAndPageStacksButNoPictures) {
  const TempFolder folder;
  for (const char* name : {"b.nii.gz", "a.nrrd", ".hidden.nii", "c.png", "notes.txt"}) {
    write_bytes(folder / name, "x");
  }
  TiffPage page;
  page.pixels = std::string(24, '\0');
  write_bytes(folder / "d.tif", tiff_bytes({page}));
  write_bytes(folder / "e.tif", tiff_bytes({page, page}));
  WideBudget budget;
  EXPECT_THAT(masks_in(folder.path(), budget),
              ElementsAre(folder / "a.nrrd", folder / "b.nii.gz", folder / "e.tif"));
}

TEST(MaskFolder, GridsMustAgree) {
  VoxelGrid a;
  a.size = {3, 4, 5};
  VoxelGrid b = a;
  EXPECT_NO_THROW(require_same_grid("b", b, "a", a));
  b.origin.y = 5e-4;
  EXPECT_NO_THROW(require_same_grid("b", b, "a", a));
  b.origin.y = 0.5;
  EXPECT_REFUSED(require_same_grid("b", b, "/x/a.nii", a),
                 AllOf(HasSubstr("b: expected the grid of a.nii"), HasSubstr("0.5 voxels away")));
  b = a;
  b.spacing.z = 1.01;  // the far end is 0.04 voxels away
  EXPECT_REFUSED(require_same_grid("b", b, "a", a), HasSubstr("0.04 voxels away"));
  b.size = {3, 4, 6};
  EXPECT_REFUSED(require_same_grid("b", b, "a", a), HasSubstr("found 3 x 4 x 6 voxels"));
}

LabelFile file_of(const std::vector<std::uint16_t>& labels) {
  LabelFile file{{}, "test", {"same"}};
  file.map.size = {static_cast<Index>(labels.size()), 1, 1};
  file.map.layers = {labels};
  return file;
}

/// A reader whose headers state the grids of the files.
MaskReader reader_of(const std::function<LabelFile(const std::filesystem::path&)>& read) {
  return {read, [read](const std::filesystem::path& path) {
            return std::optional<VoxelGrid>(read(path).map);
          }};
}

TEST(MaskFolder, TheOnlyFileIsReadAsItIs) {
  WideBudget budget;
  const MaskReader read = reader_of([](const auto&) { return file_of({1, 2}); });
  EXPECT_EQ(read_masks({"a"}, read, budget).format, "test");
  EXPECT_REFUSED(read_masks({"a", "b"}, read, budget), HasSubstr("the labels 1 and 2"));
}

TEST(MaskFolder, WarningsOfAllFilesComeOnce) {
  WideBudget budget;
  const MaskReader read = reader_of([](const std::filesystem::path& path) {
    return file_of(path == "a" ? std::vector<std::uint16_t>{7, 0}
                               : std::vector<std::uint16_t>{0, 3});
  });
  const LabelFile file = read_masks({"a", "b"}, read, budget);
  EXPECT_THAT(file.warnings, ElementsAre("same"));
  EXPECT_THAT(file.map.layers, ElementsAre(ElementsAre(1, 2)));
}

}  // namespace
}  // namespace mesamis
