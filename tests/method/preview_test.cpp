// SPDX-License-Identifier: Apache-2.0
#include "mesamis/method/preview.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "mesamis/base/single_precision.h"
#include "mesamis/base/threads.h"
#include "mesamis/method/mes_amis.h"
#include "mesamis/surface/self_intersections.h"
#include "support/ball_volume.h"

namespace mesamis {
namespace {

TEST(Preview, IsAClosedBallWithoutAMesh) {
  const Volume ball = make_ball({.noise = 3, .radius = 11});
  Settings settings;
  settings.preview = true;
  const Result result = mes_amis(ball, settings);
  EXPECT_TRUE(result.mesh.cells.empty());
  EXPECT_TRUE(result.u.empty());
  EXPECT_EQ(result.iterations.size(), 1U);
  EXPECT_TRUE(result.converged);
  const SurfaceCheck check = check_surface(result.surface);
  EXPECT_EQ(solid_flaws_of(check), "");
  EXPECT_EQ(check.components, 1);
  const double volume = 4.0 / 3 * std::numbers::pi * std::pow(middle_radius(11, 1), 3);
  EXPECT_NEAR(check.volume, volume, 0.02 * volume);
}

/// A rough one, far from the origin, where single precision is coarse.
Result preview_of_rough_ball(Settings settings) {
  Volume ball = make_ball({.noise = 20, .radius = 9});
  ball.origin = {5000, -3000, 20000};
  settings.preview = true;
  return mes_amis(ball, settings);
}

TEST(Preview, MeetsItselfNowhereInSinglePrecision) {
  const Result result = preview_of_rough_ball({});
  const TriMesh& surface = result.surface;
  for (const Vec3& p : surface.points) EXPECT_EQ(p, rounded(p));
  EXPECT_EQ(solid_flaws_of(check_surface(surface)), "");
  EXPECT_TRUE(find_self_intersections(surface).empty());
  const Result again = with_threads(1, [] { return preview_of_rough_ball({}); });
  EXPECT_EQ(again.surface.points, surface.points);
  EXPECT_EQ(again.surface.triangles, surface.triangles);
}

TEST(Preview, IsDecimatedIfAsked) {
  const auto triangles = std::ssize(preview_of_rough_ball({}).surface.triangles);
  Settings within, few;
  within.tolerance = 0.1;
  few.triangles = 500;
  const Result kept = preview_of_rough_ball(within), stopped = preview_of_rough_ball(few);
  EXPECT_TRUE(kept.printable.within(0.1));
  EXPECT_LT(std::ssize(kept.surface.triangles), triangles / 2);
  EXPECT_LE(std::ssize(stopped.surface.triangles), 500);
  for (const Result* result : {&kept, &stopped}) {
    EXPECT_EQ(solid_flaws_of(check_surface(result->surface)), "");
    EXPECT_TRUE(find_self_intersections(result->surface).empty());
  }
}

}  // namespace
}  // namespace mesamis
