// SPDX-License-Identifier: Apache-2.0
#include "mesamis/label_files/contour_grid.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/contour_bytes.h"
#include "support/expect_near.h"
#include "support/temp_folder.h"
#include "support/throws.h"

namespace mesamis {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

/// A region of rectangles of 4 x 6 mm in planes.
StructureSet rectangles(const std::vector<double>& heights) {
  StructureSet set;
  set.regions.resize(1);
  for (const double z : heights) {
    set.regions[0].contours.push_back({rectangle_contour({10, 20, z}, 4, 6).points});
  }
  return set;
}

struct Place {
  TempFolder folder;
  std::filesystem::path file = folder / "a.dcm";
  Place() { write_bytes(file, std::string(10'000, 'x')); }
};

VoxelGrid scan() {
  VoxelGrid grid;
  grid.size = {40, 50, 30};
  grid.spacing = {0.5, 1, 2};
  grid.origin = {3, 4, 5};
  return grid;
}

TEST(ContourGrid, HasThePixelsOfTheScanAndThePlanesOfTheContours) {
  const Place place;
  const ContourGrid placed = place_contours(place.file, rectangles({5, 9, 13}), scan());
  EXPECT_EQ(placed.grid.spacing, (Vec3{0.5, 1, 4}));
  EXPECT_EQ(placed.grid.size[2], 5);
  EXPECT_TRUE(placed.on_scan);
  EXPECT_THAT(placed.warnings, IsEmpty());
  // Pixels of the scan, and a voxel beyond the contours at each end.
  const Vec3 first = scan().to_grid(placed.grid.origin);
  EXPECT_DOUBLE_EQ(first.x, 0.5 * 13);
  EXPECT_DOUBLE_EQ(first.y, 15);
  EXPECT_DOUBLE_EQ(first.z, -4);
  const PlaneContour& contour = placed.contours[0][1];
  EXPECT_DOUBLE_EQ(contour.slice, 2);
  const Vec3 corner = placed.grid.to_world({contour.points[0].x * 0.5, contour.points[0].y, 8});
  EXPECT_LT(norm(corner - Vec3{10, 20, 9}), 1e-12);
}

TEST(ContourGrid, PlanesMayLieAcrossAnyAxisOfATurnedScan) {
  const Place place;
  VoxelGrid turned = scan();
  const double c = std::cos(0.4), s = std::sin(0.4);
  turned.direction = Mat3{{Vec3{0, c, -s}, Vec3{0, s, c}, Vec3{1, 0, 0}}};  // i along z
  turned.size = {30, 50, 60};
  turned.spacing = {2, 1, 0.5};
  StructureSet across;
  across.regions.resize(1);
  for (const double along : {4.0, 6.0, 8.0}) {
    Contour contour;
    for (const Vec3& p : rectangle_contour({2, 3, 0}, 4, 6).points) {
      contour.points.push_back(turned.to_world({along, p.x, p.y}));
    }
    across.regions[0].contours.push_back(contour);
  }
  const ContourGrid placed = place_contours(place.file, across, turned);
  EXPECT_EQ(placed.grid.spacing, (Vec3{1, 0.5, 2}));
  EXPECT_TRUE(placed.on_scan);
  const PlanePoint p = placed.contours[0][0].points[0];
  EXPECT_LT(
      norm(placed.grid.to_world({p.x * 1, p.y * 0.5, 2}) - across.regions[0].contours[0].points[0]),
      1e-9);
}

TEST(ContourGrid, WithoutAScanHasPixelsAsLongAsTheEdges) {
  const Place place;
  const ContourGrid placed = place_contours(place.file, rectangles({5, 11}), std::nullopt);
  EXPECT_EQ(placed.grid.spacing, (Vec3{6, 6, 6}));
  EXPECT_FALSE(placed.on_scan);
  EXPECT_THAT(placed.warnings, ElementsAre(HasSubstr("contours state no pixels")));
}

TEST(ContourGrid, OfAScanThatLiesAskewHasAxesOfItsOwn) {
  const Place place;
  VoxelGrid askew = scan();
  askew.direction = Mat3{{Vec3{1, 0, 0}, Vec3{0, 0.8, -0.6}, Vec3{0, 0.6, 0.8}}};
  const ContourGrid placed = place_contours(place.file, rectangles({5, 7}), askew);
  EXPECT_FALSE(placed.on_scan);
  EXPECT_THAT(placed.warnings, SizeIs(1));
  EXPECT_LT(norm(transpose(placed.grid.direction).rows[2] - Vec3{0, 0, 1}), 1e-12);
}

TEST(ContourGrid, HeightsThatDifferByRoundingAreOnePlane) {
  const Place place;
  const ContourGrid placed = place_contours(place.file, rectangles({5, 5.004, 7, 9.003}), scan());
  EXPECT_EQ(placed.grid.size[2], 5);
  EXPECT_EQ(placed.contours[0][0].slice, placed.contours[0][1].slice);
  EXPECT_TRUE(placed.on_scan);
}

TEST(ContourGrid, UnevenPlanesGiveAFinerGridWithAWarning) {
  const Place place;
  const ContourGrid placed = place_contours(place.file, rectangles({5, 7, 10, 12.7}), scan());
  EXPECT_FALSE(placed.on_scan);
  EXPECT_DOUBLE_EQ(placed.grid.spacing.z, 2);
  EXPECT_THAT(placed.warnings, ElementsAre(HasSubstr("uneven distances")));
}

TEST(ContourGrid, ContoursAcrossOthersAndAskewOnesAreLeftOut) {
  const Place place;
  StructureSet set = rectangles({5, 7, 9});
  set.regions[0].contours.push_back({{{10, 20, 5}, {12, 20, 5}, {12, 20, 8}}, false});
  const ContourGrid placed = place_contours(place.file, set, scan());
  EXPECT_THAT(placed.contours[0], SizeIs(3));
  EXPECT_THAT(placed.warnings, ElementsAre(HasSubstr("1 contours left out that do not lie")));
}

TEST(ContourGrid, OneContourIsAsThickAsASlice) {
  const Place place;
  EXPECT_EQ(place_contours(place.file, rectangles({7}), scan()).grid.spacing.z, 2);
}

TEST(ContourGrid, RefusesContoursBeyondTheScanAndGridsTooLarge) {
  const Place place;
  EXPECT_REFUSED(place_contours(place.file, rectangles({500, 502}), scan()),
                 HasSubstr("expected contours within the scan, found none"));
  StructureSet beside = rectangles({5, 7});
  for (Contour& contour : beside.regions[0].contours) {
    for (Vec3& p : contour.points) p.x += 1000;
  }
  EXPECT_REFUSED(place_contours(place.file, beside, scan()), HasSubstr("within the scan"));
  EXPECT_REFUSED(place_contours(place.file, rectangles({0, 0.2, 9e6}), std::nullopt),
                 HasSubstr("voxels"));
  StructureSet line = rectangles({5});
  line.regions[0].contours[0].points = {{1, 2, 3}, {2, 2, 3}, {3, 2, 3}};
  EXPECT_REFUSED(place_contours(place.file, line, scan()), HasSubstr("found lines and points"));
}

}  // namespace
}  // namespace mesamis
