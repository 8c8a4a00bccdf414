// SPDX-License-Identifier: Apache-2.0
#include "mesamis/baseline/isosurface.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "mesamis/base/error.h"
#include "support/ball_volume.h"

namespace mesamis {
namespace {

double relative_volume(const TriMesh& surface, double radius) {
  return check_surface(surface).volume / (4.0 / 3 * std::numbers::pi * radius * radius * radius);
}

TEST(Isosurface, OfABallIsClosedOutwardAndInPlace) {
  Volume volume = make_ball({.noise = 0});
  volume.origin = {5, -7, 100};
  volume.direction.rows[0] = {-1, 0, 0};  // left-handed: still outward
  const TriMesh surface = isosurface(volume, 175);
  EXPECT_TRUE(check_surface(surface).closed());
  EXPECT_NEAR(relative_volume(surface, middle_radius(11, 1)), 1, 0.02);
  const Vec3 center = volume.to_world(0.5 * volume.box().extent());
  for (const Vec3& p : surface.points) EXPECT_NEAR(norm(p - center), 11, 0.3);
}

TEST(Isosurface, SmoothsAndDecimates) {
  const Volume volume = make_ball({.noise = 15});
  const TriMesh full = isosurface(volume, 175);
  const TriMesh few = isosurface(volume, 175, {.smooth_voxels = 1, .triangles = 1000});
  EXPECT_LE(few.triangles.size(), 1010u);
  EXPECT_GT(full.triangles.size(), 5 * few.triangles.size());
  EXPECT_NEAR(relative_volume(few, middle_radius(11, std::sqrt(2))), 1, 0.05);
}

TEST(Isosurface, ClosesWhatLeavesTheVolumeOnItsBox) {
  const Volume whole = make_ball({.noise = 0});
  const Index middle = whole.size[0] / 2;
  const Volume half = crop(whole, {.begin = {middle, 0, 0}, .end = {-1, -1, -1}});
  const SurfaceCheck open = check_surface(isosurface(half, 175));
  EXPECT_FALSE(open.closed());
  const TriMesh surface = isosurface(half, 175, {.close_at_box = true});
  const SurfaceCheck check = check_surface(surface);
  EXPECT_TRUE(check.closed());
  EXPECT_TRUE(check.manifold());
  EXPECT_GT(check.volume, 0);
  double least = 1e300;
  for (const Vec3& p : surface.points) least = std::min(least, p.x);
  EXPECT_NEAR(least, half.origin.x, 0.01);
}

TEST(Isosurface, RefusesALevelNothingCrosses) {
  EXPECT_THROW(isosurface(make_ball({}), 1e6), InputError);
  EXPECT_THROW(isosurface(make_ball({}), 1e6, {.close_at_box = true}), InputError);
  for (const double bad : {-1.0, 7e8, std::numeric_limits<double>::infinity(), std::nan("")}) {
    EXPECT_THROW(isosurface(make_ball({}), 175, {.smooth_voxels = bad}), InputError) << bad;
  }
}

}  // namespace
}  // namespace mesamis
