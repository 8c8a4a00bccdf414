// SPDX-License-Identifier: Apache-2.0
#include "mesamis/surface/signed_distance.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "mesamis/surface/distance.h"
#include "support/expect_near.h"
#include "support/shapes.h"
#include "support/solids.h"
#include "support/throws.h"
#include "surface/random_surfaces.h"

namespace mesamis {
namespace {

using testing::HasSubstr;

TEST(SignedDistance, OfACubeAtItsFacesEdgesAndCorners) {
  const SignedDistance distance(cube());
  const auto face = distance.at({0.4, 0.3, 1.25});
  EXPECT_DOUBLE_EQ(face.signed_to, 0.25);
  expect_near(face.point, {0.4, 0.3, 1});
  expect_near(face.normal, {0, 0, 1});
  const auto edge = distance.at({1.3, 0.3, 1.4});
  EXPECT_DOUBLE_EQ(edge.signed_to, 0.5);
  expect_near(edge.point, {1, 0.3, 1});
  expect_near(edge.normal, {std::sqrt(0.5), 0, std::sqrt(0.5)});
  const auto corner = distance.at({-1, -2, -2});
  EXPECT_DOUBLE_EQ(corner.signed_to, 3);
  expect_near(corner.point, {0, 0, 0});
  expect_near(corner.normal, {-std::sqrt(1.0 / 3), -std::sqrt(1.0 / 3), -std::sqrt(1.0 / 3)});
  const auto inside = distance.at({0.5, 0.4, 0.1});
  EXPECT_DOUBLE_EQ(inside.signed_to, -0.1);
  EXPECT_DOUBLE_EQ(inside.distance, 0.1);
  expect_near(inside.normal, {0, 0, -1});
}

TEST(SignedDistance, OnTheSurfaceIsZero) {
  const SignedDistance distance(cube());
  for (const Vec3& p : {Vec3{0.3, 0.6, 0}, Vec3{0.3, 1, 0}, Vec3{1, 1, 1}, Vec3{0.5, 0.5, 1}}) {
    EXPECT_LT(distance.at(p).distance, 1e-15);
  }
}

/// A prism along z from 0 to 1 over an L, whose inner corner is at (1, 1).
const std::array<Vec3, 6> kL{Vec3{0, 0, 0}, Vec3{2, 0, 0}, Vec3{2, 1, 0},
                             Vec3{1, 1, 0}, Vec3{1, 2, 0}, Vec3{0, 2, 0}};

TriMesh l_prism() {
  TriMesh mesh;
  for (const double z : {0.0, 1.0}) {
    for (const Vec3& p : kL) mesh.points.push_back(p + Vec3{0, 0, z});
  }
  for (Index i = 1; i + 1 < 6; ++i) {
    mesh.triangles.push_back({0, i + 1, i});
    mesh.triangles.push_back({6, 6 + i, 6 + i + 1});
  }
  for (Index i = 0; i < 6; ++i) {
    const Index j = (i + 1) % 6;
    mesh.triangles.push_back({i, j, 6 + j});
    mesh.triangles.push_back({i, 6 + j, 6 + i});
  }
  return mesh;
}

double distance_to_l(const Vec3& p) {
  double least = INFINITY;
  for (std::size_t i = 0; i < 6; ++i) {
    const Vec3 a = kL[i], ab = kL[(i + 1) % 6] - a, ap = Vec3{p.x, p.y, 0} - a;
    const double share = std::clamp(dot(ap, ab) / dot(ab, ab), 0.0, 1.0);
    least = std::min(least, norm(ap - share * ab));
  }
  const bool inside = p.x > 0 && p.y > 0 && p.x < 2 && p.y < 2 && (p.x < 1 || p.y < 1);
  return inside ? -least : least;
}

double distance_to_l_prism(const Vec3& p) {
  const double across = distance_to_l(p), along = std::abs(p.z - 0.5) - 0.5;
  if (across < 0 && along < 0) return std::max(across, along);
  return std::hypot(std::max(across, 0.0), std::max(along, 0.0));
}

TEST(SignedDistance, OfAConcavePrismIsExactEverywhere) {
  const TriMesh prism = l_prism();
  ASSERT_EQ(solid_flaws_of(check_surface(prism)), "");
  const SignedDistance distance(prism);
  auto points = random_points(3000, {-0.5, -0.5, -0.5}, {2.5, 2.5, 1.5}, 3);
  const auto near_corner = random_points(1000, {0.9, 0.9, 0.9}, {1.1, 1.1, 1.1}, 4);
  points.insert(points.end(), near_corner.begin(), near_corner.end());
  for (const Vec3& p : points) {
    EXPECT_NEAR(distance.at(p).signed_to, distance_to_l_prism(p), 1e-12)
        << p.x << ' ' << p.y << ' ' << p.z;
  }
}

/// All features of a finely cut ball, where its facets allow for no more than their own depth.
TEST(SignedDistance, OfABallIsThatFromItsCentre) {
  constexpr Index kTurns = 96;
  const SignedDistance distance(ball_surface(10, kTurns));
  const double facet = 10 * (1 - std::cos(std::numbers::pi / kTurns));
  for (const Vec3& p : random_points(3000, {-15, -15, -15}, {15, 15, 15}, 5)) {
    const double expected = norm(p) - 10;
    const NearestPoint found = distance.at(p);
    EXPECT_NEAR(found.signed_to, expected, 3 * facet);
    EXPECT_NEAR(norm(found.normal), 1, 1e-12);
  }
}

TEST(SignedDistance, AgreesWithTheDistancesToTheSurface) {
  const TriMesh surface = joined(l_prism(), moved(ball_surface(0.7, 20), {1.8, 1.9, 0.4}));
  const SignedDistance distance(surface);
  const auto points = random_points(2000, {-2, -2, -2}, {4, 4, 3}, 6);
  const auto expected = distances_to_surface(points, surface);
  std::vector<Vec3> nearest;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const NearestPoint found = distance.at(points[i]);
    EXPECT_NEAR(found.distance, expected[i], 1e-12);
    EXPECT_EQ(std::abs(found.signed_to), found.distance);
    EXPECT_NEAR(norm(found.point - points[i]), found.distance, 1e-12);
    nearest.push_back(found.point);
    TriMesh one{surface.points, {surface.triangles[found.triangle]}};
    const double off = distances_to_surface(std::span(&found.point, 1), one)[0];
    EXPECT_LT(off, 1e-12) << "the triangle does not hold the point";
  }
  for (const double d : distances_to_surface(nearest, surface)) EXPECT_LT(d, 1e-12);
}

TEST(SignedDistance, RefusesASurfaceWithoutTriangles) {
  EXPECT_REFUSED(SignedDistance({}), HasSubstr("expected triangles, found none"));
  EXPECT_REFUSED(SignedDistance({{{0, 0, 0}}, {}}), HasSubstr("expected triangles, found none"));
  EXPECT_REFUSED(SignedDistance({{{0, 0, 0}}, {{0, 1, 2}}}), testing::_);
}

}  // namespace
}  // namespace mesamis
