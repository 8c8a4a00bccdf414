// SPDX-License-Identifier: Apache-2.0
#include "mesamis/printing/print_bed.h"

#include <gtest/gtest.h>

#include <limits>

#include "mesamis/base/error.h"
#include "mesamis/mesh/tet_mesh.h"
#include "support/expect_near.h"
#include "support/shapes.h"

namespace mesamis {
namespace {

TEST(PrintBed, PutsTheSurfaceInTheMiddleAtHeightZero) {
  const PrintBed bed{300, 200, 100};
  const TriMesh before = cube({-110.25, -210.5, -310.125}, 20);
  const PlacedSurface placed = place_on_bed(before, bed);
  const Box box = bounding_box(placed.surface.points);
  expect_near(placed.size, {20, 20, 20});
  expect_near(box.lo, {140, 90, 0}, 1e-12);
  expect_near(box.hi, {160, 110, 20}, 1e-12);
  EXPECT_EQ(placed.surface.triangles, before.triangles);
}

TEST(PrintBed, PointsWithoutTrianglesDoNotCount) {
  TriMesh surface = cube({0, 0, 0}, 10);
  surface.points.push_back({1000, 1000, -1000});
  const PlacedSurface placed = place_on_bed(surface, {});
  expect_near(placed.size, {10, 10, 10});
  expect_near(placed.surface.points[0], {120, 100, 0});
}

TEST(PrintBed, ASurfaceOfTheSizeOfTheBedFits) {
  const PrintBed bed{20, 30, 40};
  EXPECT_TRUE(fits_on(bed, {20, 30, 40}));
  EXPECT_FALSE(fits_on(bed, {20.01, 30, 40}));
  EXPECT_FALSE(fits_on(bed, {20, 30.01, 40}));
  EXPECT_FALSE(fits_on(bed, {20, 30, 40.01}));
}

TEST(PrintBed, RefusesBedsOutOfRangeAndEmptySurfaces) {
  EXPECT_NO_THROW(require_valid(PrintBed{}));
  EXPECT_NO_THROW(require_valid(PrintBed{kBedLengthMin, kBedLengthMax, 1}));
  for (const double length : {0.0, -1.0, 0.99, 1.01e4, std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_THROW(require_valid(PrintBed{length, 100, 100}), InputError) << length;
    EXPECT_THROW(require_valid(PrintBed{100, length, 100}), InputError) << length;
    EXPECT_THROW(require_valid(PrintBed{100, 100, length}), InputError) << length;
  }
  EXPECT_THROW(place_on_bed({}, {}), InputError);
  EXPECT_THROW(place_on_bed(cube(), {0, 0, 0}), InputError);
}

TEST(PrintBed, SizesAreWrittenInMillimetres) {
  EXPECT_EQ(size_text({19.5, 300, 210}), "19.5 x 300 x 210 mm");
}

}  // namespace
}  // namespace mesamis
