// SPDX-License-Identifier: Apache-2.0
#include "mesamis/label_files/seg_grid.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "support/expect_near.h"
#include "support/seg_bytes.h"
#include "support/temp_folder.h"
#include "support/throws.h"
#include "support/wide_budget.h"

namespace mesamis {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

/// The grid of frames at these heights along z.
SegGrid grid_of(SegBytes seg, const std::vector<double>& heights) {
  const TempFolder folder;
  seg.frames.clear();
  for (const double height : heights) seg.frames.push_back({1, {10, 20, height}, {}});
  write_bytes(folder / "a.dcm", seg.bytes());
  WideBudget budget;
  const DicomFile file = read_dicom_file(folder / "a.dcm", budget);
  return grid_of_frames(file, pixels_of(file, PixelUse::kLabels));
}

TEST(SegGrid, IsThatOfEvenFrames) {
  const SegGrid seg = grid_of({}, {30, 32, 34});
  EXPECT_THAT(seg.slice, ElementsAre(0, 1, 2));
  EXPECT_THAT(seg.grid.size, ElementsAre(3, 5, 3));
  EXPECT_EQ(seg.grid.spacing, (Vec3{0.5, 1.25, 2}));
  EXPECT_EQ(seg.grid.origin, (Vec3{10, 20, 30}));
  EXPECT_EQ(seg.grid.direction, Mat3{});
}

TEST(SegGrid, TakesFramesInAnyOrderAndSeveralAtOnePosition) {
  EXPECT_THAT(grid_of({}, {34, 30, 32, 34, 30}).slice, ElementsAre(2, 0, 1, 2, 0));
}

TEST(SegGrid, LeavesRoomForFramesThatAreMissing) {
  const SegGrid seg = grid_of({}, {0, 2, 10, 16});
  EXPECT_THAT(seg.slice, ElementsAre(0, 1, 5, 8));
  EXPECT_EQ(seg.grid.spacing.z, 2);
  SegBytes stated;
  stated.slice_spacing = 2;
  EXPECT_THAT(grid_of(stated, {0, 6, 10}).slice, ElementsAre(0, 3, 5));
  stated.slice_spacing = 3;  // which does not fit
  EXPECT_THAT(grid_of(stated, {0, 2, 4, 8}).slice, ElementsAre(0, 1, 2, 4));
}

TEST(SegGrid, OfOnePositionHasTheStatedStep) {
  SegBytes seg;
  EXPECT_REFUSED(grid_of(seg, {5, 5}), HasSubstr("Spacing Between Slices (0018,0088)"));
  seg.slice_thickness = 4;
  EXPECT_EQ(grid_of(seg, {5, 5}).grid.spacing.z, 4);
  seg.slice_spacing = 3;
  EXPECT_EQ(grid_of(seg, {5, 5}).grid.spacing.z, 3);
}

TEST(SegGrid, RoundedPositionsDoNotAddUp) {
  std::vector<double> heights;
  for (int n = 0; n < 500; ++n) heights.push_back(std::round(n * 0.6666667 * 1000) / 1000);
  SegBytes seg;
  seg.slice_spacing = 0.667;
  const SegGrid rounded = grid_of(seg, heights);
  EXPECT_EQ(rounded.grid.size[2], 500);
  EXPECT_NEAR(rounded.grid.spacing.z, 0.6666667, 1e-5);
}

TEST(SegGrid, LiesObliquely) {
  const TempFolder folder;
  SegBytes seg;
  const double c = 0.8, s = 0.6;
  seg.orientation = {c, s, 0, 0, 0, -1};  // the normal is row x column: (-s, c, 0)
  for (int k = 0; k < 3; ++k) seg.frames.push_back({1, {1 - s * k * 3, 2 + c * k * 3, 5}, {}});
  write_bytes(folder / "a.dcm", seg.bytes());
  WideBudget budget;
  const DicomFile file = read_dicom_file(folder / "a.dcm", budget);
  const VoxelGrid grid = grid_of_frames(file, pixels_of(file, PixelUse::kLabels)).grid;
  EXPECT_NEAR(grid.spacing.z, 3, 1e-9);
  expect_near(grid.to_world({0, 0, 6}), {1 - 6 * s, 2 + 6 * c, 5}, 1e-9);
  expect_near(grid.to_world({1, 1.25, 0}), {1 + c, 2 + s, 3.75}, 1e-9);
}

TEST(SegGrid, RefusesPositionsThatFormNone) {
  EXPECT_REFUSED(grid_of({}, {0, 2, 4, 7}), HasSubstr("expected positions of a regular grid"));
  EXPECT_REFUSED(grid_of({}, {0, 2, 4, 7}), HasSubstr("between frame 3 and frame 4"));
  SegBytes stated;
  stated.slice_spacing = 1;
  EXPECT_REFUSED(grid_of(stated, {0, 1e7}), HasSubstr("8192 voxels per byte"));
  EXPECT_NO_THROW(grid_of({}, {0, 2.01, 4, 5.98}));
}

TEST(SegGrid, RefusesFramesThatDifferInTheirPlane) {
  const TempFolder folder;
  const auto refused = [&folder](const SegBytes& seg, const char* why) {
    write_bytes(folder / "a.dcm", seg.bytes());
    WideBudget budget;
    const DicomFile file = read_dicom_file(folder / "a.dcm", budget);
    EXPECT_REFUSED(grid_of_frames(file, pixels_of(file, PixelUse::kLabels)), HasSubstr(why));
  };
  SegBytes seg = small_seg();
  seg.frames[1].position[0] += 1;
  refused(seg, "found frame 2 shifted by 1 mm");
  seg = small_seg();
  seg.frames[2].position.clear();
  refused(seg, "Image Position (0020,0032)");
  seg = small_seg();
  seg.orientation = {1, 0, 0, 0, 2, 0};
  refused(seg, "unit vectors");
  seg.orientation = {1, 0, 0, 1, 0, 0};
  refused(seg, "right angles, found a cosine of 1");
}

TEST(SegGrid, BoundsTheVoxelsByTheBytesOfTheFile) {
  const TempFolder folder;
  write_bytes(folder / "a.dcm", std::string(10, 'x'));
  DicomFile file;
  file.path = folder / "a.dcm";
  VoxelGrid grid;
  grid.size = {1024, 8, 10};
  EXPECT_NO_THROW(require_voxels(file, grid, 1));
  EXPECT_REFUSED(require_voxels(file, grid, 2), HasSubstr("1024 x 8 x 10 x 2 voxels in 10 bytes"));
}

}  // namespace
}  // namespace mesamis
