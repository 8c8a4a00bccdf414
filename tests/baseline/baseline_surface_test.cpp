// SPDX-License-Identifier: Apache-2.0
#include "mesamis/baseline/baseline_surface.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "mesamis/restore/half_maximum_level.h"
#include "support/ball_volume.h"
#include "support/throws.h"

namespace mesamis {
namespace {

Volume ball() { return make_ball({.size = 30, .noise = 2, .radius = 9}); }

TEST(MakeBaseline, IsTheIsosurfaceAtTheLevelMidway) {
  const Volume volume = ball();
  BaselineOptions options;
  options.isosurface.smooth_voxels = 0.6;
  const BaselineSurface made = make_baseline(volume, options);
  EXPECT_EQ(made.level, find_half_maximum_level(volume).level);
  const TriMesh expected = isosurface(volume, made.level, options.isosurface);
  EXPECT_EQ(made.surface.points, expected.points);
  EXPECT_EQ(made.surface.triangles, expected.triangles);
  EXPECT_FALSE(made.contour);
  EXPECT_TRUE(made.converged());
}

TEST(MakeBaseline, TakesTheLevelGiven) {
  BaselineOptions options;
  options.level = 200;
  const BaselineSurface high = make_baseline(ball(), options);
  EXPECT_EQ(high.level, 200);
  options.level = 150;
  const BaselineSurface low = make_baseline(ball(), options);
  EXPECT_LT(check_surface(high.surface).volume, check_surface(low.surface).volume);
  options.level = 5000;
  EXPECT_REFUSED(make_baseline(ball(), options), testing::_);
}

TEST(MakeBaseline, FollowsAContourFromTheLevel) {
  BaselineOptions options;
  options.method = BaselineMethod::kGeodesic;
  options.isosurface.smooth_voxels = 3;  // not of the level set
  if (!has_geodesic_contour()) {
    EXPECT_REFUSED(make_baseline(ball(), options), testing::HasSubstr("ITK"));
    return;
  }
  const Volume volume = ball();
  const BaselineSurface made = make_baseline(volume, options);
  ASSERT_TRUE(made.contour);
  EXPECT_EQ(made.converged(), made.contour->converged);
  const GeodesicContour contour = geodesic_contour(volume, made.level, options.geodesic);
  EXPECT_EQ(made.surface.points, isosurface(contour.level_set, 0).points);
}

TEST(MakeBaseline, SaysWhenTheContourDidNotRest) {
  if (!has_geodesic_contour()) GTEST_SKIP() << "the library was built without ITK";
  BaselineOptions options;
  options.method = BaselineMethod::kGeodesic;
  options.geodesic.iterations = 1;
  options.geodesic.shrink = 2;
  EXPECT_FALSE(make_baseline(ball(), options).converged());
}

}  // namespace
}  // namespace mesamis
