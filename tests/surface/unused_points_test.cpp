// SPDX-License-Identifier: Apache-2.0
#include "mesamis/surface/unused_points.h"

#include <gtest/gtest.h>

#include "support/shapes.h"

namespace mesamis {
namespace {

TEST(WithoutUnusedPoints, KeepsPlacesAndOrder) {
  TriMesh surface = random_triangles(40, {1, 1, 1});
  const TriMesh before = surface;
  std::erase_if(surface.triangles, [](const Triangle& t) { return t[0] % 2 != 0; });
  const TriMesh after = without_unused_points(surface);
  EXPECT_EQ(after.points.size(), 60u);
  ASSERT_EQ(after.triangles.size(), surface.triangles.size());
  for (std::size_t t = 0; t < after.triangles.size(); ++t) {
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_EQ(after.points[after.triangles[t][i]], before.points[surface.triangles[t][i]]);
      EXPECT_EQ(after.triangles[t][i], static_cast<Index>(3 * t + i));  // the order stays
    }
  }
}

TEST(WithoutUnusedPoints, ChangesNothingWhereAllAreUsed) {
  const TriMesh surface = cube(), same = without_unused_points(surface);
  EXPECT_EQ(same.points, surface.points);
  EXPECT_EQ(same.triangles, surface.triangles);
}

TEST(WithoutUnusedPoints, LeavesNoPointWithoutTriangles) {
  EXPECT_TRUE(without_unused_points({{{1, 2, 3}, {4, 5, 6}}, {}}).points.empty());
}

}  // namespace
}  // namespace mesamis
