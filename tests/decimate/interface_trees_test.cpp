// SPDX-License-Identifier: Apache-2.0
#include "mesamis/decimate/interface_trees.h"

#include <gtest/gtest.h>

namespace mesamis {
namespace {

/// Two triangles of interface 1 over a square, one of interface 0 beside it, and a point of none.
SplitSurface three_triangles() {
  return {{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {2, 0, 0}, {9, 9, 9}},
           {{0, 1, 2}, {0, 2, 3}, {1, 4, 2}}},
          {1, 1, 0}};
}

TEST(InterfacesOfPoints, AreThoseOfAllTheirTriangles) {
  EXPECT_EQ(interfaces_of_points(three_triangles()),
            (std::vector<Index>{1, kNoIndex, kNoIndex, 1, 0, kNoIndex}));
}

TEST(InterfaceTrees, SearchAmongTheTrianglesOfOneInterface) {
  const InterfaceTrees trees(three_triangles(), 2);
  std::vector<std::size_t> hints = trees.hints();
  ASSERT_EQ(hints.size(), 2U);
  const Vec3 p{0.1, 0.9, 2};
  EXPECT_NEAR(trees.tree(1).squared_distance_to(p, hints[1]), 4, 1e-12);
  EXPECT_EQ(trees.index_of(1, hints[1]), 1);
  EXPECT_NEAR(trees.tree(0).squared_distance_to(p, hints[0]), 4.81, 1e-12) << "to (1, 0.9, 0)";
  EXPECT_EQ(trees.index_of(0, hints[0]), 2);
}

}  // namespace
}  // namespace mesamis
