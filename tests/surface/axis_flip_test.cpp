// SPDX-License-Identifier: Apache-2.0
#include "mesamis/surface/axis_flip.h"

#include <gmock/gmock.h>

#include <cmath>

#include "mesamis/base/error.h"
#include "mesamis/mesh/tet_mesh.h"
#include "mesamis/surface/extract.h"
#include "support/shapes.h"

namespace mesamis {
namespace {

/// A pear: thin at one end along each axis, so that no flip maps it onto itself.
TriMesh pear(const Vec3& center, double size = 10, Index bricks = 14) {
  const TetMesh mesh = box_mesh({{-2, -2, -2}, {2, 2, 2}}, {bricks, bricks, bricks});
  std::vector<double> u;
  for (const Vec3& p : mesh.points) {
    u.push_back(1.3 - norm({p.x + 0.3 * p.y * p.y, 0.7 * p.y - 0.3 * p.z, 1.5 * p.z + 0.2 * p.x}));
  }
  TriMesh surface = extract_solid(mesh, u, 0);
  for (Vec3& p : surface.points) p = center + size * p;
  return surface;
}

TriMesh flipped(TriMesh surface, const AxisFlip& flip) {
  for (Vec3& p : surface.points) p = flip(p);
  return surface;
}

TEST(AxisFlip, ExchangesAndNegates) {
  const AxisFlip flip{{2, 0, 1}, {1, -1, 1}};
  EXPECT_EQ(flip({1, 2, 3}), (Vec3{3, -1, 2}));
  EXPECT_EQ(to_string(flip), "(z, -x, y)");
  EXPECT_EQ(to_string(kLpsRas), "(-x, -y, z)");
}

TEST(BoxMisfit, IsAShareOfTheDiagonal) {
  const Box a{{0, 0, 0}, {3, 4, 0}};
  EXPECT_EQ(box_misfit(a, a), 0);
  EXPECT_DOUBLE_EQ(box_misfit(a, {{0, 0, 1}, {3, 4, 1}}), 0.2);
  EXPECT_DOUBLE_EQ(box_misfit({{0, 0, 1}, {3, 4, 1}}, a), 0.2);
  const Box point{{1, 1, 1}, {1, 1, 1}};
  EXPECT_EQ(box_misfit(point, point), 0);
  EXPECT_TRUE(std::isinf(box_misfit(point, {{2, 2, 2}, {2, 2, 2}})));
}

TEST(FindAxisFlip, FindsEveryFlipOfAnObjectAwayFromTheOrigin) {
  const TriMesh reference = pear({31, -120, 400});
  for (const AxisFlip& flip :
       {kLpsRas, AxisFlip{{0, 1, 2}, {1, -1, 1}}, AxisFlip{{0, 1, 2}, {1, 1, -1}},
        AxisFlip{{2, 1, 0}, {1, 1, 1}}, AxisFlip{{1, 2, 0}, {-1, 1, -1}}}) {
    const TriMesh surface = flipped(pear({31, -120, 400}, 10.1, 11), flip);
    const auto found = find_axis_flip(reference, surface);
    ASSERT_TRUE(found) << to_string(flip);
    EXPECT_TRUE(found->plain);
    for (const Vec3& p : {Vec3{1, 2, 3}, Vec3{4, -6, 5}}) EXPECT_EQ(found->flip(flip(p)), p);
    EXPECT_GT(found->misfit, 0.2);
    EXPECT_LT(found->flipped_misfit, 0.05);
    EXPECT_GT(found->distance_mm, 20);
    EXPECT_LT(found->flipped_distance_mm, 1);
  }
}

TEST(FindAxisFlip, FindsAPartOfTheWhole) {
  // Half an object: the boxes do not fit well after the flip, the surfaces do.
  const TriMesh whole = pear({0, 80, 10});
  TriMesh part{whole.points, {}};
  for (const Triangle& t : whole.triangles) {
    if (whole.points[t[0]].z > 10) part.triangles.push_back(t);
  }
  EXPECT_FALSE(find_axis_flip(whole, part));
  EXPECT_FALSE(find_axis_flip(part, whole));
  EXPECT_EQ(find_axis_flip(whole, flipped(part, kLpsRas))->flip, kLpsRas);
  EXPECT_EQ(find_axis_flip(part, flipped(whole, kLpsRas))->flip, kLpsRas);
}

TEST(FindAxisFlip, LeavesAloneWhatFitsBothWays) {
  const TriMesh at_origin = pear({0, 0, 0});
  EXPECT_FALSE(find_axis_flip(at_origin, at_origin));
  EXPECT_FALSE(find_axis_flip(cube({-1, -1, -1}, 2), cube({-1.1, -1.1, -1.1}, 2.2)));
  // Off by a little, symmetrical about the origin: a flip fits better, by chance.
  EXPECT_FALSE(find_axis_flip(cube({-1.01, -1, -1}, 2), cube({-0.99, -1, -1}, 2)));
}

TEST(FindAxisFlip, LeavesAloneDifferentPartsThatOverlap) {
  const TriMesh a = pear({40, 50, 60});
  for (const Vec3& shift : {Vec3{5, 0, 0}, Vec3{0, -9, 0}, Vec3{8, 8, 8}, Vec3{0, 0, 30}}) {
    EXPECT_FALSE(find_axis_flip(a, pear(Vec3{40, 50, 60} + shift, 7)));
    EXPECT_FALSE(find_axis_flip(pear(Vec3{40, 50, 60} + shift, 7), a));
  }
  // About the origin, where flips move little.
  for (const Vec3& shift : {Vec3{5, 0, 0}, Vec3{0, -9, 0}, Vec3{8, 8, 8}, Vec3{0, 0, 14}}) {
    const auto found = find_axis_flip(pear({0, 0, 0}), pear(shift, 7));
    EXPECT_FALSE(found && found->plain) << to_string(found->flip);
  }
}

TEST(FindAxisFlip, IsNotPlainWhereTheBoxesStillOverlapWell) {
  // 3 mm from the origin, 30 mm long: likely a flip, but perhaps two objects.
  const TriMesh surface = pear({0, 3, 0});
  const auto found = find_axis_flip(flipped(surface, kLpsRas), surface);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->flip, kLpsRas);
  EXPECT_FALSE(found->plain);
}

TEST(FindAxisFlip, IgnoresPointsWithoutTriangles) {
  TriMesh surface = pear({0, 60, 0});
  const TriMesh reference = flipped(surface, kLpsRas);
  surface.points.push_back({1e6, 1e6, 1e6});
  EXPECT_TRUE(find_axis_flip(reference, surface));
}

TEST(FindAxisFlip, RefusesWhatHasNoArea) {
  const TriMesh flat{{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {{0, 1, 2}}};
  EXPECT_THROW(find_axis_flip({{}, {{0, 1, 2}}}, cube()), InputError);
  EXPECT_THROW(find_axis_flip(flat, flipped(flat, {{0, 1, 2}, {-1, 1, 1}})), InputError);
}

}  // namespace
}  // namespace mesamis
