// SPDX-License-Identifier: Apache-2.0
#include "mesamis/report/line_crossing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

#include "mesamis/surface/tri_mesh.h"

namespace mesamis {
namespace {

/// An octahedron, counter-clockwise seen from outside: corners, edges and faces that lines meet.
const std::vector<Vec3> kPoints{{1, 0, 0},  {-1, 0, 0}, {0, 1, 0},
                                {0, -1, 0}, {0, 0, 1},  {0, 0, -1}};
const std::vector<Triangle> kTriangles{{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4},
                                       {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};

std::vector<LineCrossing> crossings(double y, double z) {
  std::vector<LineCrossing> found;
  for (const Triangle& t : kTriangles) {
    const auto c = line_crossing({{{kPoints[static_cast<std::size_t>(t[0])], t[0]},
                                   {kPoints[static_cast<std::size_t>(t[1])], t[1]},
                                   {kPoints[static_cast<std::size_t>(t[2])], t[2]}}},
                                 y, z);
    if (c) found.push_back(*c);
  }
  std::sort(found.begin(), found.end(),
            [](const LineCrossing& a, const LineCrossing& b) { return a.x < b.x; });
  return found;
}

TEST(LineCrossing, IsWhereTheLineEntersAndLeaves) {
  const auto found = crossings(0.25, 0.125);
  ASSERT_EQ(found.size(), 2u);
  EXPECT_NEAR(found[0].x, -0.625, 1e-14);
  EXPECT_NEAR(found[1].x, 0.625, 1e-14);
  EXPECT_EQ(found[0].inward, 1);
  EXPECT_EQ(found[1].inward, -1);
}

TEST(LineCrossing, ThroughCornersAndEdgesEntersAsOftenAsItLeaves) {
  for (const double y : {-1.0, -0.5, 0.0, 0.5, 1.0}) {
    for (const double z : {-1.0, -0.5, 0.0, 0.5, 1.0}) {
      int depth = 0;
      for (const LineCrossing& c : crossings(y, z)) {
        depth += c.inward;
        EXPECT_GE(depth, 0) << y << ' ' << z;
        EXPECT_LE(depth, 1) << y << ' ' << z;
      }
      EXPECT_EQ(depth, 0) << y << ' ' << z;
    }
  }
}

TEST(LineCrossing, ThroughCornersWithinIsInsideBetweenThem) {
  const auto found = crossings(0, 0);
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[0].x, -1);
  EXPECT_EQ(found[1].x, 1);
}

TEST(LineCrossing, IsNoneBeside) { EXPECT_TRUE(crossings(0.8, 0.3).empty()); }

}  // namespace
}  // namespace mesamis
