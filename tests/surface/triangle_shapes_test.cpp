// SPDX-License-Identifier: Apache-2.0
#include "mesamis/surface/triangle_shapes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace mesamis {
namespace {

const Vec3 kApex{0.5, std::sqrt(0.75), 0};

TEST(TriangleShapes, ARegularTriangleHasSixtyDegrees) {
  const TriangleShapes shapes = triangle_shapes({{{0, 0, 0}, {1, 0, 0}, kApex}, {{0, 1, 2}}});
  EXPECT_NEAR(shapes.least_angle, 60, 1e-12);
  EXPECT_EQ(shapes.share_above_30_deg, 1);
}

TEST(TriangleShapes, TheWorstTriangleCountsAndItsShare) {
  // 1, 2 and sqrt(5): its least angle is atan(1/2), 26.57 degrees.
  const TriMesh surface{{{0, 0, 5}, {1, 0, 5}, kApex + Vec3{0, 0, 5}, {0, 2, 5}},
                        {{0, 1, 2}, {0, 1, 3}, {0, 1, 2}, {2, 0, 1}}};
  const TriangleShapes shapes = triangle_shapes(surface);
  EXPECT_NEAR(shapes.least_angle, 180 / std::numbers::pi * std::atan(0.5), 1e-12);
  EXPECT_EQ(shapes.share_above_30_deg, 0.75);
}

TEST(TriangleShapes, ThinAndFlatOnesAreFound) {
  const double height = 1e-9;
  const TriMesh thin{{{0, 0, 0}, {1, 0, 0}, {0.5, height, 0}}, {{0, 1, 2}}};
  EXPECT_NEAR(triangle_shapes(thin).least_angle, 180 / std::numbers::pi * 2 * height, 1e-15);
  const TriMesh flat{{{0, 0, 0}, {1, 0, 0}, {0.5, 0, 0}}, {{0, 1, 2}}};
  EXPECT_EQ(triangle_shapes(flat).least_angle, 0);
  EXPECT_EQ(triangle_shapes(flat).share_above_30_deg, 0);
}

TEST(TriangleShapes, NothingIsWrongWithoutTriangles) {
  EXPECT_EQ(triangle_shapes({}).share_above_30_deg, 1);
}

}  // namespace
}  // namespace mesamis
