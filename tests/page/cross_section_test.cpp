// SPDX-License-Identifier: Apache-2.0
#include "mesamis/page/cross_section.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "support/sampled_volume.h"
#include "support/shapes.h"
#include "support/solids.h"

namespace mesamis {
namespace {

Volume around() {
  Volume scan = sampled_volume({41, 41, 41}, {1, 1, 1}, [](const Vec3& p) { return p.x; });
  scan.origin = {-20, -20, -20};
  return scan;
}

double length_of(const PageLine& line) {
  double length = 0;
  for (std::size_t n = 1; n < line.size(); ++n) {
    length += std::hypot(line[n][0] - line[n - 1][0], line[n][1] - line[n - 1][1]);
  }
  return length;
}

TEST(CrossSection, OfABallIsOneClosedCircle) {
  const Volume scan = around();
  for (const int axis : {0, 1, 2}) {
    const double position = 3;
    const SlicePlane plane = slice_plane(scan, axis, &position);
    const auto lines = cross_section(ball_surface(10, 96), scan, plane);
    ASSERT_EQ(lines.size(), 1u) << axis;
    EXPECT_EQ(lines[0].front(), lines[0].back());
    EXPECT_NEAR(length_of(lines[0]), 2 * std::numbers::pi * std::sqrt(100 - 9), 0.2);
  }
}

TEST(CrossSection, OfTwoCubesAreTwoLinesInTheOrderOfTheTriangles) {
  const Volume scan = around();
  const double position = 1;
  const TriMesh cubes =
      joined(cube({-9, -9, -9}, 4), joined(cube({0, 0, 0.25}, 3), cube({8, 8, 0.5}, 2)));
  const auto lines = cross_section(cubes, scan, slice_plane(scan, 2, &position));
  ASSERT_EQ(lines.size(), 2u) << "the first one lies below";
  EXPECT_NEAR(length_of(lines[0]), 12, 1e-9);
  EXPECT_NEAR(length_of(lines[1]), 8, 1e-9);
}

TEST(CrossSection, OfAnOpenSurfaceIsOneOpenLine) {
  const Volume scan = around();
  TriMesh open = cube({0, 0, 0.5}, 3);
  std::erase_if(open.triangles, [](const Triangle& t) { return t == Triangle{0, 4, 6}; });
  const double position = 1;
  const auto lines = cross_section(open, scan, slice_plane(scan, 2, &position));
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_NE(lines[0].front(), lines[0].back());
}

TEST(MiddleOf, HasHalfOfTheAreaOnEitherSide) {
  const TriMesh small = cube({0, 0, 0}, 1), large = cube({10, 0, 0}, 6);
  EXPECT_NEAR(middle_of({&small, &large}, 0), 13, 3.1);
  EXPECT_EQ(middle_of({}, 0), 0);
}

}  // namespace
}  // namespace mesamis
