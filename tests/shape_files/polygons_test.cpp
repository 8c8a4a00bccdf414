// SPDX-License-Identifier: Apache-2.0
#include "mesamis/shape_files/polygons.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/throws.h"
#include "support/wide_budget.h"

namespace mesamis {
namespace {

using Corners = std::vector<double>;

const std::filesystem::path kFile = "a.vtp";  // a sink keeps a reference

std::vector<Triangle> triangles_of(const Corners& corners, bool strip) {
  TriMesh surface;
  WideBudget budget;
  PolygonSink(kFile, surface, budget).add(corners, strip);
  return surface.triangles;
}

TEST(Polygons, BecomeFans) {
  EXPECT_EQ(triangles_of({4, 5, 6, 7, 8}, false),
            (std::vector<Triangle>{{4, 5, 6}, {4, 6, 7}, {4, 7, 8}}));
  EXPECT_TRUE(triangles_of({}, false).empty());
  EXPECT_TRUE(triangles_of({1, 2}, false).empty());
}

/// VTK's rule: every other triangle is turned, so that all face the same way.
TEST(Polygons, StripsKeepOneOrientation) {
  EXPECT_EQ(triangles_of({0, 1, 2, 3, 4}, true),
            (std::vector<Triangle>{{0, 1, 2}, {1, 3, 2}, {2, 3, 4}}));
}

TEST(Polygons, AreNumberedFromTheSurfacesPointsAtTheStart) {
  TriMesh surface;
  surface.points.resize(10);
  WideBudget budget;
  PolygonSink sink(kFile, surface, budget);
  surface.points.resize(13);
  sink.add(Corners{0, 1, 2}, false);
  EXPECT_EQ(surface.triangles, (std::vector<Triangle>{{10, 11, 12}}));
}

TEST(Polygons, ListsAreCutAtTheirOffsets) {
  TriMesh surface;
  WideBudget budget;
  PolygonSink sink(kFile, surface, budget);
  sink.add_all(Corners{0, 1, 2, 3, 4, 5, 6}, Corners{0, 3, 3, 7}, false);
  EXPECT_EQ(surface.triangles, (std::vector<Triangle>{{0, 1, 2}, {3, 4, 5}, {3, 5, 6}}));
  for (const Corners& offsets : {Corners{0, 8}, Corners{3, 2}, Corners{-1, 2}, Corners{0, NAN}}) {
    EXPECT_REFUSED(sink.add_all(Corners(7), offsets, false),
                   testing::HasSubstr("a.vtp: expected the corners of polygon 0 within"));
  }
}

/// A list of bytes makes twelve times as many bytes of triangles.
TEST(Polygons, TrianglesAreClaimedBeforeTheyAreMade) {
  TriMesh surface;
  MemoryBudget budget(kFile, {1e-5});
  EXPECT_REFUSED(PolygonSink(kFile, surface, budget).add(Corners(2000, 0.0), false),
                 testing::HasSubstr("for triangles"));
  EXPECT_LE(surface.triangles.capacity() * sizeof(Triangle), 10'000u);
}

TEST(Polygons, WhatIsNoNumberOfAPointIsRefused) {
  for (const double bad : {-1.0, 0.5, 2147483648.0, 1e300, double{INFINITY}, double{NAN}}) {
    EXPECT_REFUSED(triangles_of({0, 1, bad}, false), testing::HasSubstr("the number of a point"));
  }
}

}  // namespace
}  // namespace mesamis
