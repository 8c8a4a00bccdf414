// SPDX-License-Identifier: Apache-2.0
#include "mesamis/report/centre_faces.h"

#include <gtest/gtest.h>

#include <utility>

namespace mesamis {
namespace {

constexpr double kHair = 1e-3;

/// A block between two corners.
TriMesh block(const Vec3& lo, const Vec3& hi) {
  TriMesh mesh;
  for (int n = 0; n < 8; ++n) {
    mesh.points.push_back(
        {(n & 1) != 0 ? hi.x : lo.x, (n & 2) != 0 ? hi.y : lo.y, (n & 4) != 0 ? hi.z : lo.z});
  }
  mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                    {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return mesh;
}

TEST(CentreFaces, MoveOutwardHoweverTheyAreRoundedOrMirrored) {
  for (const bool mirrored : {false, true}) {
    TriMesh b = block({0.4 * kHair, 1.5, -0.9 * kHair}, {3 - 0.7 * kHair, 4.5, 7 + 0.2 * kHair});
    if (mirrored) {
      for (Triangle& t : b.triangles) std::swap(t[0], t[1]);
    }
    EXPECT_TRUE(move_centre_faces(b.points, b.triangles, kHair, 2 * kHair));
    for (int n = 0; n < 8; ++n) {
      const Vec3& p = b.points[static_cast<std::size_t>(n)];
      EXPECT_DOUBLE_EQ(p.x, (n & 1) != 0 ? 3 + 1.3 * kHair : -1.6 * kHair);
      EXPECT_EQ(p.y, (n & 2) != 0 ? 4.5 : 1.5);
      EXPECT_DOUBLE_EQ(p.z, (n & 4) != 0 ? 7 + 2.2 * kHair : -2.9 * kHair);
    }
  }
}

TEST(CentreFaces, MoveInwardToo) {
  TriMesh b = block({0, 0, 0}, {3, 4, 5.5});
  EXPECT_TRUE(move_centre_faces(b.points, b.triangles, kHair, -0.25));
  EXPECT_EQ(b.points.front(), (Vec3{0.25, 0.25, 0.25}));
  EXPECT_EQ(b.points.back(), (Vec3{2.75, 3.75, 5.5}));
}

TEST(CentreFaces, OfACavityMoveIntoIt) {
  TriMesh b = block({0.5, 0.5, 0.5}, {9.5, 9.5, 9.5});
  const TriMesh inner = block({3, 3, 3}, {6, 6, 6});
  b.points.insert(b.points.end(), inner.points.begin(), inner.points.end());
  for (const Triangle& t : inner.triangles) {
    b.triangles.push_back({t[1] + 8, t[0] + 8, t[2] + 8});
  }
  EXPECT_TRUE(move_centre_faces(b.points, b.triangles, kHair, 2 * kHair));
  EXPECT_DOUBLE_EQ(b.points[8].x, 3 + 2 * kHair);
  EXPECT_DOUBLE_EQ(b.points[15].z, 6 - 2 * kHair);
  EXPECT_EQ(b.points[0].x, 0.5);
}

TEST(CentreFaces, LeaveAllElseWhereItIs) {
  // A face beside the centres, and a splinter that is upright on them.
  TriMesh b = block({0.5, 2 * kHair, 0.5}, {3.2, 3 - 2 * kHair, 3.5});
  const TriMesh before = b;
  EXPECT_FALSE(move_centre_faces(b.points, b.triangles, kHair, 2 * kHair));
  EXPECT_EQ(b.points, before.points);
  b = block({0.5, 1 - kHair / 4, 0.5}, {3.2, 1 + kHair / 4, 3.5});  // both faces on one plane
  EXPECT_TRUE(move_centre_faces(b.points, b.triangles, kHair, 2 * kHair));
  EXPECT_GT(b.points[2].y, 1 + kHair);
  EXPECT_EQ(b.points[2].x, 0.5);
  EXPECT_FALSE(move_centre_faces(b.points, {}, kHair, kHair));
}

}  // namespace
}  // namespace mesamis
