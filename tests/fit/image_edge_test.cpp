// SPDX-License-Identifier: Apache-2.0
#include "mesamis/fit/image_edge.h"

#include <gtest/gtest.h>

#include "support/ball_volume.h"

namespace mesamis {
namespace {

constexpr double kBall = 11;

/// Of a ball without noise: 120 around it, 230 within.
const SplineImage& clean_ball() {
  static const SplineImage image = interpolating_spline(make_ball({.noise = 0, .radius = kBall}));
  return image;
}

/// At so many millimetres outside of the ball, along an oblique direction.
ImageEdge seen_from(double outside, double contrast, double reach = 1.6) {
  const FollowSpace space(clean_ball(), 1);
  const Vec3 normal = unit_or_zero({0.3, -0.5, 0.8});
  const Vec3 centre = 0.5 * clean_ball().grid.box().extent();
  return find_image_edge(space, centre + (kBall + outside) * normal, normal, contrast, reach);
}

TEST(ImageEdge, LiesWhereTheObjectEnds) {
  for (const double outside : {-1.2, -0.7, -0.1, 0.0, 0.4, 1.1}) {
    const ImageEdge edge = seen_from(outside, 110);
    EXPECT_NEAR(edge.distance, -outside, 0.15) << outside;  // the blur draws the middle inwards
    EXPECT_GT(edge.weight, 0.5) << outside;
  }
}

TEST(ImageEdge, IsNoneWhereTheImageRises) { EXPECT_EQ(seen_from(0.2, -110).weight, 0); }

TEST(ImageEdge, IsNoneBeyondTheReach) {
  EXPECT_EQ(seen_from(4, 110).weight, 0);
  EXPECT_EQ(seen_from(-4, 110).weight, 0);
  EXPECT_GT(seen_from(2.5, 110, 4).weight, 0);
}

TEST(ImageEdge, IsLessSureForAWeakEdge) {
  EXPECT_LT(seen_from(0.2, 400).weight, seen_from(0.2, 110).weight)
      << "an edge of another object, too weak for this contrast";
}

}  // namespace
}  // namespace mesamis
