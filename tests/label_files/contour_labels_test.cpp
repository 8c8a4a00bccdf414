// SPDX-License-Identifier: Apache-2.0
#include "mesamis/label_files/contour_labels.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/contour_bytes.h"
#include "support/temp_folder.h"
#include "support/throws.h"

namespace mesamis {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

VoxelGrid scan() {
  VoxelGrid grid;
  grid.size = {64, 60, 20};
  grid.spacing = {0.5, 0.6, 2};
  grid.origin = {-15, -16, 1};
  grid.frame_of_reference = "1.2.9";
  return grid;
}

LabelFile read(const StructureBytes& bytes, bool with_scan = true) {
  const TempFolder folder;
  write_bytes(folder / "rt.dcm", bytes.bytes());
  LabelOptions options;
  if (with_scan) options.scan = scan;
  LabelFile file = read_label_map(folder / "rt.dcm", options);
  EXPECT_NO_THROW(require_valid(file.map));
  return file;
}

/// Contours of one region, the same in so many planes 2 mm apart.
StructureBytes region_of(const std::vector<RegionContour>& contours, int planes = 4) {
  StructureBytes set;
  set.regions.resize(1);
  for (int k = 0; k < planes; ++k) {
    for (RegionContour contour : contours) {
      for (Vec3& p : contour.points) p.z = 5 + 2.0 * k;
      set.regions[0].contours.push_back(contour);
    }
  }
  return set;
}

/// mm^2 in each plane.
double area_of(const LabelFile& file, std::size_t region = 0, int planes = 4) {
  const auto voxels = static_cast<double>(voxel_counts(file.map)[region]);
  return voxels * file.map.spacing.x * file.map.spacing.y / planes;
}

constexpr double kPi = std::numbers::pi;
/// Half a voxel of the scan, mm^2, and rounding.
constexpr double kClose = 0.5 * 0.5 * 0.6 + 0.01;

RegionContour circle(double radius, double x = 1, bool backwards = false) {
  return circle_contour({x, 2, 0}, radius, backwards);
}

TEST(ContourLabels, AreaOfACircleIsThatOfTheVoxels) {
  for (const bool with_scan : {true, false}) {
    const LabelFile file = read(region_of({circle(10)}), with_scan);
    const double close = 0.51 * file.map.spacing.x * file.map.spacing.y + 0.01;
    EXPECT_NEAR(area_of(file), kPi * 100, close) << with_scan;
    EXPECT_EQ(file.format, "DICOM structure set");
    EXPECT_EQ(file.map.segments[0], (Segment{"bone", 1, 0, {255, 128, 0}}));
  }
}

TEST(ContourLabels, HolesByDirectionByKeyholeAndByNesting) {
  RegionContour keyhole = circle(10);
  const RegionContour hole = circle(6, 1, true);
  keyhole.points.push_back(keyhole.points.front());
  keyhole.points.insert(keyhole.points.end(), hole.points.begin(), hole.points.end());
  keyhole.points.push_back(hole.points.front());
  RegionContour exclusive = circle(6), outer = circle(10);
  exclusive.type = outer.type = "CLOSEDPLANAR_XOR";
  for (const auto& contours : {std::vector{keyhole}, std::vector{circle(10), hole},
                               std::vector{circle(6), circle(10)}, std::vector{outer, exclusive}}) {
    EXPECT_NEAR(area_of(read(region_of(contours))), kPi * (100 - 36), kClose);
  }
}

TEST(ContourLabels, AnIslandInAHoleAndTwoIslands) {
  EXPECT_NEAR(area_of(read(region_of({circle(3), circle(10), circle(6)}))), kPi * (100 - 36 + 9),
              kClose);
  const LabelFile two = read(region_of({circle(4, -5), circle(5, 6)}));
  EXPECT_NEAR(area_of(two), kPi * (16 + 25), kClose);
  EXPECT_THAT(two.warnings, IsEmpty());
}

TEST(ContourLabels, OverlappingAndRepeatedContoursAreUnited) {
  EXPECT_NEAR(area_of(read(region_of({circle(8), circle(8)}))), kPi * 64, kClose);
  const RegionContour left = rectangle_contour({-5, 0, 0}, 6, 6),
                      right = rectangle_contour({-2, 3, 0}, 6, 6);
  const LabelFile both = read(region_of({left, right}));
  EXPECT_NEAR(area_of(both), 72 - 9, kClose);
  EXPECT_THAT(both.warnings, Contains(HasSubstr("overlap are united: \"bone\"")));
}

/// Many programs draw contours through the centres of pixels, of which then half is inside.
TEST(ContourLabels, ContoursThroughPixelCentresAreNotShifted) {
  const LabelFile file = read(region_of({rectangle_contour({-5, -4, 0}, 10, 12)}));
  EXPECT_NEAR(area_of(file), 120, kClose);
  Vec3 sum;
  std::size_t count = 0;
  for (std::size_t n = 0; n < file.map.voxel_count(); ++n) {
    if (file.map.layers[0][n] == 0) continue;
    const auto [i, j, k] = file.map.voxel(n);
    sum = sum + file.map.to_world({i * 0.5, j * 0.6, k * 2.0});
    ++count;
  }
  const Vec3 middle = 1.0 / static_cast<double>(count) * sum;
  // Of two opposite edges each may have half a voxel more than its half, and so may the area.
  const double share = 1.5 / (static_cast<double>(count) / 4);  // of the voxels in a plane
  EXPECT_NEAR(middle.x, 0, 5 * share);
  EXPECT_NEAR(middle.y, 2, 6 * share);
}

TEST(ContourLabels, OverlappingRegionsLieInDifferentLayers) {
  StructureBytes bytes = region_of({circle(10)});
  bytes.regions.push_back(region_of({circle(5)}).regions[0]);
  bytes.regions[1].number = 2;
  bytes.regions[1].name = "marrow";
  const LabelFile file = read(bytes);
  EXPECT_EQ(file.map.segments[1].layer, 1);
  EXPECT_NEAR(area_of(file, 0), kPi * 100, kClose);
  EXPECT_NEAR(area_of(file, 1), kPi * 25, kClose);
  EXPECT_THAT(file.warnings, Contains(HasSubstr("\"marrow\"")));
}

TEST(ContourLabels, PlanesBetweenThoseOfARegionBelongToIt) {
  StructureBytes bytes = region_of({circle(10)}, 9);
  auto sparse = region_of({circle(5)}, 9).regions[0];
  for (std::size_t k = 8; k < 9; --k) {
    if (k % 2) sparse.contours.erase(sparse.contours.begin() + static_cast<std::ptrdiff_t>(k));
  }
  sparse.number = 2;
  bytes.regions.push_back(sparse);
  const LabelFile file = read(bytes);
  EXPECT_NEAR(area_of(file, 1, 10), kPi * 25, kClose);  // 5 planes of twice the thickness
  bytes.regions[0].contours.erase(bytes.regions[0].contours.begin() + 3,
                                  bytes.regions[0].contours.begin() + 6);
  const LabelFile gap = read(bytes);
  EXPECT_NEAR(area_of(gap, 0, 6), kPi * 100, kClose);
  EXPECT_THAT(gap.warnings, Contains(HasSubstr("stay open between others: \"bone\"")));
}

TEST(ContourLabels, ContoursBetweenTheSlicesOfTheScanKeepTheirPlace) {
  StructureBytes bytes = region_of({circle(10)}, 10);
  for (RegionContour& contour : bytes.regions[0].contours) {
    for (Vec3& p : contour.points) p.z = 6 + 0.7 * (p.z - 5);
  }
  const LabelFile file = read(bytes);
  EXPECT_NEAR(file.map.spacing.z, 1.4, 1e-9);
  const LabelMap on_scan = labels_on(file.map, scan());
  // 10 planes of 1.4 mm from 5.3 to 19.3 mm: the slices at 7, 9, ... 19 mm.
  EXPECT_NEAR(static_cast<double>(voxel_counts(on_scan)[0]) * 0.5 * 0.6 / 7, kPi * 100, kClose);
}

TEST(ContourLabels, ARegionAcrossTheOthersHasNoVoxel) {
  StructureBytes bytes = region_of({circle(10)});
  RegionBytes across;
  across.number = 2;
  across.name = "across";
  across.contours = {{{{0, 2, 5}, {3, 2, 5}, {3, 2, 8}}}};
  bytes.regions.push_back(across);
  const LabelFile file = read(bytes);
  EXPECT_EQ(voxel_counts(file.map)[1], 0u);
  EXPECT_THAT(file.warnings, Contains(HasSubstr("no voxel lies within the contours: \"across\"")));
}

TEST(ContourLabels, TheFrameOfReferenceIsTheScans) {
  StructureBytes bytes = region_of({circle(10)});
  bytes.frame = bytes.regions[0].frame = "1.2.10";
  EXPECT_THAT(read(bytes).warnings,
              Contains(HasSubstr("\"1.2.10\" is not the scan's, \"1.2.9\": its contours lie on")));
  for (RegionContour& contour : bytes.regions[0].contours) {
    for (Vec3& p : contour.points) p.z += 0.8;
  }
  EXPECT_REFUSED(read(bytes), HasSubstr("expected the scan's frame of reference, \"1.2.9\", "
                                        "found \"1.2.10\""));
  bytes.regions.push_back(region_of({circle(5)}).regions[0]);
  bytes.regions[1].number = 2;
  bytes.regions[1].name = "marrow";
  const LabelFile file = read(bytes);
  ASSERT_THAT(file.map.segments, SizeIs(1));
  EXPECT_THAT(file.warnings,
              Contains(HasSubstr("another frame of reference than the scan's left out: \"bone\"")));
}

TEST(ContourLabels, ThatOverlapWithoutEndAreRefused) {
  std::vector<PlaneContour> contours;
  for (int n = 0; n < 3000; ++n) {
    contours.push_back({0, {{0, 0}, {500, 0}, {500, 500}, {0, 500 - 0.01 * n}}, false});
  }
  bool overlaps = false;
  EXPECT_REFUSED(filled_plane("f", contours, {0, 0, 512, 512}, overlaps),
                 HasSubstr("found too many"));
}

}  // namespace
}  // namespace mesamis
