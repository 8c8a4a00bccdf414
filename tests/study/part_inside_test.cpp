// SPDX-License-Identifier: Apache-2.0
#include "mesamis/study/part_inside.h"

#include <gtest/gtest.h>

#include "support/shapes.h"

namespace mesamis {
namespace {

/// A grid whose axes are turned and shifted against the world: i runs along y, j along -x.
Volume turned_grid() {
  Volume volume;
  volume.size = {11, 6, 4};
  volume.spacing = {1, 2, 3};
  volume.origin = {100, 50, -20};
  volume.direction.rows = {Vec3{0, -1, 0}, Vec3{1, 0, 0}, Vec3{0, 0, 1}};
  return volume;
}

bool is_inside(const Volume& volume, const Vec3& margin, const Vec3& p) {
  return Box{margin, volume.box().hi - margin}.contains(volume.to_grid(p));
}

TEST(PartInside, KeepsExactlyTheTrianglesInside) {
  const Volume volume = turned_grid();
  const Vec3 margin{1, 2, 0.5};
  TriMesh surface = random_triangles(20000, {14, 14, 12});
  for (Vec3& p : surface.points) p = volume.to_world(p - Vec3{2, 2, 1});
  std::size_t expected = 0;
  for (const Triangle& t : surface.triangles) {
    expected += is_inside(volume, margin, surface.points[t[0]]) &&
                is_inside(volume, margin, surface.points[t[1]]) &&
                is_inside(volume, margin, surface.points[t[2]]);
  }
  const TriMesh part = part_inside(surface, volume, margin);
  ASSERT_GT(expected, 10u);
  ASSERT_LT(expected, surface.triangles.size());
  EXPECT_EQ(part.triangles.size(), expected);
  for (const Vec3& p : part.points) EXPECT_TRUE(is_inside(volume, margin, p));
  EXPECT_EQ(part.points.size(), 3 * expected) << "no unused points";
}

TEST(PartInside, IsTheWholeSurfaceOrNothing) {
  const Volume volume = turned_grid();
  TriMesh surface = cube({2, 2, 2}, 3);
  for (Vec3& p : surface.points) p = volume.to_world(p);
  const TriMesh part = part_inside(surface, volume, {1, 1, 1});
  EXPECT_EQ(part.points.size(), surface.points.size());
  EXPECT_EQ(part.triangles, surface.triangles);
  for (Vec3& p : surface.points) p += Vec3{1000, 0, 0};
  EXPECT_TRUE(part_inside(surface, volume, {0, 0, 0}).triangles.empty());
  EXPECT_TRUE(part_inside(surface, volume, {0, 0, 0}).points.empty());
}

}  // namespace
}  // namespace mesamis
