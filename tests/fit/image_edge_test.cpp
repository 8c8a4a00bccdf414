// SPDX-License-Identifier: Apache-2.0
#include "mesamis/fit/image_edge.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/ball_volume.h"
#include "support/sampled_volume.h"

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
  return find_image_edge(space, centre + (kBall + outside) * normal, normal, {contrast, reach});
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

/// Half way between the ball's value and that around it.
constexpr SheetLevel kSheets{175, 110};

/// A slab across x, from x = 14 on, blurred by 0.6 voxels; its faces have so much of the contrast.
SplineImage slab(double thickness, double contrast, double of_faces) {
  const auto step = [](double t) { return 0.5 * std::erfc(-t / (0.6 * std::sqrt(2))); };
  const auto share = [&](double x) { return step(x - 14) - step(x - 14 - thickness); };
  return interpolating_spline(sampled_volume({34, 9, 9}, {1, 1, 1}, [&](const Vec3& p) {
    return 120 + contrast * of_faces / share(14) * share(p.x);
  }));
}

/// How far outside of the slab's first face its edge is seen; of the gap's face, if all is turned.
double seen_outside(const SplineImage& image, const SheetLevel& sheets, double contrast) {
  const ImageEdge edge =
      find_image_edge(FollowSpace(image, 1), {13.8, 4, 4}, {-1, 0, 0}, {contrast, 1.6, sheets});
  EXPECT_GT(edge.weight, 0);
  return 0.2 + edge.distance;
}

TEST(ImageEdge, OfASheetLiesWhereTheImageHasItsLevel) {
  for (const double thickness : {1.4, 1.6, 1.8}) {
    const SplineImage wall = slab(thickness, 110, 0.5), gap = slab(thickness, -110, 0.5);
    const SheetLevel around_gap{65, 110};
    EXPECT_GT(seen_outside(wall, {}, 110), 0.1) << "half of what the wall reaches";
    EXPECT_NEAR(seen_outside(wall, kSheets, 110), 0, 0.05) << thickness;
    EXPECT_NEAR(seen_outside(gap, around_gap, -110), 0, 0.05) << thickness;
  }
}

TEST(ImageEdge, OfWhatIsNoSheetOrLessDenseHasItsOwnLevel) {
  const SplineImage thick = slab(7, 80, 0.5), weak = slab(1.2, 110, 0.3);
  for (const SplineImage& image : {thick, weak}) {
    EXPECT_EQ(seen_outside(image, kSheets, 80), seen_outside(image, {}, 80));
  }
}

}  // namespace
}  // namespace mesamis
