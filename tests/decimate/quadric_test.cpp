// SPDX-License-Identifier: Apache-2.0
#include "mesamis/decimate/quadric.h"

#include <gtest/gtest.h>

namespace mesamis {
namespace {

Quadric corner() {
  Quadric q;
  q.add_plane({1, 0, 0}, 1, 1);
  q.add_plane({0, 1, 0}, 2, 1);
  q.add_plane({0, 0, 1}, 3, 2);
  return q;
}

TEST(Quadric, IsTheSumOfSquaredDistances) {
  Quadric q = corner();
  EXPECT_NEAR(q.at({1, 2, 3}), 0, 1e-14);
  EXPECT_NEAR(q.at({2, 4, 4}), 1 + 4 + 2, 1e-14);
  q += corner();
  EXPECT_NEAR(q.at({2, 4, 4}), 14, 1e-14);
  EXPECT_EQ(q.weight, 8);
}

TEST(Quadric, OfALineIsTheSquaredDistanceFromIt) {
  for (const Vec3& along : {Vec3{1, 0, 0}, {0, 0, 1}, {0.6, 0, 0.8}, {0.48, 0.6, 0.64}}) {
    Quadric q;
    const Vec3 on{1, -2, 3}, x{0.3, 0.4, -0.7};
    q.add_line(on, along, 5);
    const Vec3 way = x - on, across = way - dot(way, along) * along;
    EXPECT_NEAR(q.at(x), 5 * dot(across, across), 1e-12);
    EXPECT_NEAR(q.at(on + 4 * along), 0, 1e-12);
  }
}

TEST(Minimum, IsWhereThePlanesMeet) {
  const Vec3 x = minimum(corner(), {0, 0, 0}, 1e-9, {});
  EXPECT_NEAR(norm(x - Vec3{1, 2, 3}), 0, 1e-6);
}

TEST(Minimum, GoesNoFartherThanItMustWhereItIsFlat) {
  Quadric q;
  q.add_plane({0, 0, 1}, 3, 5);
  const Vec3 x = minimum(q, {7, 8, 2}, 1e-3, {});
  EXPECT_NEAR(x.x, 7, 1e-12);
  EXPECT_NEAR(x.y, 8, 1e-12);
  EXPECT_NEAR(x.z, 3, 2e-3);
  EXPECT_EQ(minimum(Quadric{}, {7, 8, 2}, 1e-3, {}), (Vec3{7, 8, 2}));
}

TEST(Minimum, KeepsTheCoordinatesThatStay) {
  const Vec3 x = minimum(corner(), {0, 5, 0}, 1e-9, {false, true, false});
  EXPECT_NEAR(x.x, 1, 1e-6);
  EXPECT_EQ(x.y, 5);
  EXPECT_NEAR(x.z, 3, 1e-6);
}

}  // namespace
}  // namespace mesamis
