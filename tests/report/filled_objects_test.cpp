// SPDX-License-Identifier: Apache-2.0
#include "mesamis/report/filled_objects.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <numbers>
#include <set>

#include "mesamis/base/error.h"
#include "mesamis/surface/distance.h"
#include "support/solids.h"
#include "support/throws.h"

namespace mesamis {
namespace {

using testing::HasSubstr;

constexpr double kRadius = 8, kTolerance = 0.2;

VoxelGrid turned_grid(double z) {
  VoxelGrid grid{.size = {25, 25, 25}, .origin = {3, -5, 7}};
  grid.direction = Mat3{{Vec3{0.8, -0.6, 0}, Vec3{0.6, 0.8, 0}, Vec3{0, 0, z}}};
  return grid;
}

/// A ball in the grid's middle, turned outward in the world.
TriMesh ball_in(const VoxelGrid& grid, double radius = kRadius) {
  TriMesh surface = ball_surface(radius, 48);
  for (Vec3& p : surface.points) p = grid.to_world(p + Vec3{12, 12, 12});
  if (determinant(grid.direction) < 0) {
    for (Triangle& t : surface.triangles) std::swap(t[1], t[2]);
  }
  return surface;
}

BodyOptions of_size(double size) {
  BodyOptions options;
  options.element_size = size;
  options.tolerance = kTolerance;
  options.skins = true;
  return options;
}

TEST(FilledObjects, SkinsLieOnTheSurfaceInAnyGrid) {
  for (const double z : {1.0, -1.0}) {
    const VoxelGrid grid = turned_grid(z);
    const TriMesh surface = ball_in(grid);
    const FoundObject object{surface, {"ball", 1, 0, {}}};
    const FilledObjects filled = fill_objects({&object, 1}, grid, of_size(3));
    ASSERT_EQ(filled.skins.size(), 1U);
    const TriMesh& skin = filled.skins[0];
    EXPECT_EQ(solid_flaws_of(check_surface(skin)), "");
    EXPECT_LT(max_distance(skin, surface, 0.002), kTolerance);
    EXPECT_LT(max_distance(surface, skin, 0.002), kTolerance);
  }
}

TEST(FilledObjects, SkinsAreThereOnlyWhereTheyAreAskedFor) {
  const VoxelGrid grid = turned_grid(1);
  const TriMesh surface = ball_in(grid);
  const FoundObject object{surface, {"ball", 1, 0, {}}};
  BodyOptions options = of_size(0);
  options.skins = false;
  const FilledObjects filled = fill_objects({&object, 1}, grid, options);
  EXPECT_TRUE(filled.skins.empty());
  EXPECT_EQ(filled.body.element_size, 3) << "three voxels";
}

/// A part that a body leaves out, as nothing holds it, is in the skin.
TEST(FilledObjects, SmallPartsStayInTheSkin) {
  const VoxelGrid grid{.size = {41, 25, 25}};
  TriMesh surface = ball_in(grid);
  TriMesh small = ball_surface(0.8, 24);
  const auto offset = static_cast<Index>(surface.points.size());
  for (const Vec3& p : small.points) surface.points.push_back(p + Vec3{30, 12, 12});
  for (const Triangle& t : small.triangles) {
    surface.triangles.push_back({t[0] + offset, t[1] + offset, t[2] + offset});
  }
  const FoundObject object{surface, {"two", 1, 0, {}}};
  const FilledObjects filled = fill_objects({&object, 1}, grid, of_size(2));
  EXPECT_EQ(filled.body.parts, 1);
  EXPECT_EQ(filled.body.parts_dropped, 1);
  EXPECT_EQ(check_surface(filled.skins[0]).components, 2);
}

TEST(FilledObjects, AnObjectOfWhichNothingIsLeftIsNamed) {
  const VoxelGrid grid{.size = {25, 25, 25}};
  const TriMesh surface = ball_in(grid);
  const FoundObject whole{surface, {"whole", 1, 0, {}}}, same{surface, {"same", 2, 0, {}}};
  const std::vector<FoundObject> both{whole, same};  // each point is of one of them
  EXPECT_REFUSED(fill_objects(both, grid, of_size(3)), HasSubstr("found none left of it"));
}

}  // namespace
}  // namespace mesamis
