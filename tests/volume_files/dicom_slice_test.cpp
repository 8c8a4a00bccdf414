// SPDX-License-Identifier: Apache-2.0
#include "mesamis/volume_files/dicom_slice.h"

#include <gmock/gmock.h>

#include "support/dicom_bytes.h"
#include "support/expect_near.h"
#include "support/temp_folder.h"
#include "support/wide_budget.h"

namespace mesamis {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

DicomImage described(const std::string& bytes) {
  const TempFolder folder;
  write_bytes(folder / "a.dcm", bytes);
  WideBudget budget;
  return describe_image(read_dicom_file(folder / "a.dcm", budget), budget);
}

TEST(DicomSlice, HasPlaceSpacingAndRescaleOfItsFile) {
  SliceBytes bytes;
  bytes.position = {1, -2, 3.5};
  bytes.orientation = {0, 1, 0, 0, 0, -1};
  bytes.slope = 2;
  bytes.intercept = -1024;
  const DicomImage image = described(bytes.bytes());
  EXPECT_EQ(image.series, "1.2.3");
  EXPECT_EQ(image.modality, "CT");
  EXPECT_EQ(image.description, "made here");
  EXPECT_EQ(image.problem, "");
  EXPECT_TRUE(image.has_pixels);
  ASSERT_EQ(image.slices.size(), 1u);
  const DicomSlice& slice = image.slices[0];
  expect_near(slice.position, {1, -2, 3.5});
  expect_near(slice.along_row, {0, 1, 0});
  expect_near(slice.along_column, {0, 0, -1});
  // Pixel Spacing gives the distance of rows first.
  EXPECT_EQ(slice.row_step, 1.25);
  EXPECT_EQ(slice.column_step, 0.5);
  EXPECT_EQ(slice.columns, 4);
  EXPECT_EQ(slice.rows, 3);
  EXPECT_EQ(slice.slope, 2);
  EXPECT_EQ(slice.intercept, -1024);
  EXPECT_FALSE(slice.localizer);
  EXPECT_EQ(name_of(slice), "a.dcm");
}

TEST(DicomSlice, ItsNameTellsTheFrame) {
  DicomSlice slice;
  slice.file = "folder/b.dcm";
  slice.frame = 3;
  EXPECT_EQ(name_of(slice), "b.dcm frame 3");
}

TEST(DicomSlice, LocalizersAndInvertedPicturesAreNoted) {
  SliceBytes bytes;
  bytes.image_type = "ORIGINAL\\PRIMARY\\LOCALIZER";
  bytes.photometric = "MONOCHROME1";
  const DicomImage image = described(bytes.bytes());
  ASSERT_EQ(image.slices.size(), 1u);
  EXPECT_TRUE(image.slices[0].localizer);
  EXPECT_THAT(image.warning, HasSubstr("MONOCHROME1"));
}

TEST(DicomSlice, WhatCannotBeUsedIsAProblemAndNotThrown) {
  SliceBytes bytes;
  bytes.position.clear();
  const DicomImage no_place = described(bytes.bytes());
  EXPECT_THAT(no_place.problem, HasSubstr("(0020,0032)"));
  EXPECT_THAT(no_place.slices, IsEmpty());
  const std::string whole = SliceBytes{}.bytes();
  EXPECT_THAT(described(whole.substr(0, whole.size() - 4)).problem, HasSubstr("broken DICOM"));
}

TEST(DicomSlice, AReportHasNoPixels) {
  DicomWriter set;
  set.text(0x00080060, "CS", "SR");
  const DicomImage image = described(SliceBytes::file(set.bytes(), DicomCoding::kExplicit));
  EXPECT_FALSE(image.has_pixels);
  EXPECT_EQ(image.problem, "");
  EXPECT_EQ(image.modality, "SR");
}

TEST(DicomSlice, FramesAreFoundInTheirOwnGroupsThenInSharedOnes) {
  const auto group = [](DicomTag macro, DicomTag tag, const std::vector<double>& values) {
    DicomWriter item, set;
    item.decimals(tag, values);
    set.sequence(macro, {item.bytes()});
    return set.bytes();
  };
  DicomWriter set;
  set.sequence(dicom::kSharedGroups,
               {group(dicom::kPlaneOrientation, dicom::kOrientation, {1, 0, 0, 0, 1, 0}) +
                group(dicom::kPixelMeasures, dicom::kPixelSpacing, {2, 3})});
  set.sequence(dicom::kFrameGroups, {group(dicom::kPlanePosition, dicom::kPosition, {1, 2, 3}),
                                     group(dicom::kPlanePosition, dicom::kPosition, {4, 5, 6}) +
                                         group(dicom::kPixelMeasures, dicom::kSlope, {7})});
  const TempFolder folder;
  write_bytes(folder / "a.dcm", SliceBytes::file(set.bytes(), DicomCoding::kExplicit));
  WideBudget budget;
  const DicomFile file = read_dicom_file(folder / "a.dcm", budget);
  const DicomSlice slice = place_frame(file, DicomPixels{6, 5, 2}, 1);
  expect_near(slice.position, {4, 5, 6});
  EXPECT_EQ(slice.column_step, 3);
  EXPECT_EQ(slice.rows, 5);
  EXPECT_EQ(slice.frame, 1);
  const MacroTag slope{dicom::kPixelMeasures, dicom::kSlope};
  EXPECT_EQ(frame_decimals(file, 1, slope, 1), std::vector<double>{7});
  EXPECT_EQ(frame_decimals(file, 0, slope, 1), std::nullopt);
}

TEST(DicomSlice, StepsAreAsLongAsPixelsHoweverLongTheDirectionsAre) {
  DicomSlice slice;
  slice.along_row = {0, 1.01, 0};
  slice.along_column = {0, 0, -0.99};
  slice.column_step = 0.5;
  slice.row_step = 2;
  const auto [column, row, up] = grid_steps(slice, {-3, 0, 0});
  expect_near(column, {0, 0.5, 0});
  expect_near(row, {0, 0, -2});
  EXPECT_EQ(up, (Vec3{-3, 0, 0}));
}

}  // namespace
}  // namespace mesamis
