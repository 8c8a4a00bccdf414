// SPDX-License-Identifier: Apache-2.0
#include "mesamis/body/body_surface.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "support/expect_near.h"
#include "support/shapes.h"
#include "support/solids.h"
#include "support/throws.h"
#include "surface/random_surfaces.h"

namespace mesamis {
namespace {

using testing::HasSubstr;

constexpr double kRadius = 10, kTolerance = 0.1;
const Box kWide{{-12, -12, -12}, {12, 12, 12}};

BodySurface one_ball() { return {std::vector{ball_surface(kRadius, 48)}, kWide, kTolerance}; }

TEST(BodySurface, KnowsTheInsideOfABall) {
  const BodySurface ball = one_ball();
  for (const Vec3& p : random_points(1000, kWide.lo, kWide.hi, 1)) {
    const double depth = kRadius - norm(p);
    if (std::abs(depth) < 0.06) continue;
    EXPECT_EQ(ball.material_at(p), depth > 0 ? 1 : kOutside);
    EXPECT_NEAR(ball.signed_distance(1, p), -depth, 0.06);
  }
}

TEST(BodySurface, EdgesCrossABallWhereTheyDo) {
  const BodySurface ball = one_ball();
  const auto inside = random_points(200, {-5, -5, -5}, {5, 5, 5}, 2);
  const auto outside = random_points(200, {-12, -12, 10.5}, {12, 12, 12}, 3);
  for (std::size_t i = 0; i < inside.size(); ++i) {
    const Vec3 way = outside[i] - inside[i];
    // |inside + t way| = radius
    const double a = dot(way, way), b = dot(inside[i], way);
    const double c = dot(inside[i], inside[i]) - kRadius * kRadius;
    const double share = (-b + std::sqrt(b * b - a * c)) / a;
    EXPECT_NEAR(ball.crossing(inside[i], outside[i]), share, 0.005);
    EXPECT_NEAR(ball.crossing(outside[i], inside[i]), 1 - share, 0.005);
  }
}

TEST(BodySurface, AnEdgeThroughABallPassesItsMiddle) {
  const BodySurface body = one_ball();
  const auto place = body.hidden_crossing({-kRadius - 1, 0.5, 0}, {kRadius + 1, 0.5, 0});
  ASSERT_TRUE(place);
  EXPECT_NEAR(*place, 0.5, 0.2);  // so deep that half of it is in any wall
}

TEST(BodySurface, AnEdgeThatHardlyEntersABallDoesNotCount) {
  const BodySurface body = one_ball();
  auto at_height = [&](double z) {
    return body.hidden_crossing({-kRadius, 0, z}, {kRadius, 0, z});
  };
  EXPECT_FALSE(at_height(kRadius + 0.1));
  EXPECT_FALSE(at_height(kRadius - 0.5 * kTolerance));
  EXPECT_TRUE(at_height(kRadius - 3 * kTolerance));
}

TEST(BodySurface, NearestBorderOfABallIsOnTheRay) {
  const BodySurface ball = one_ball();
  for (const Vec3& p : random_points(300, kWide.lo, kWide.hi, 4)) {
    if (norm(p) < 3) continue;
    const BorderPoint border = ball.nearest_border(p);
    EXPECT_NEAR(norm(border.point), kRadius, 0.05);
    EXPECT_NEAR(norm(border.point - p), std::abs(norm(p) - kRadius), 0.05);
    EXPECT_EQ(border.tolerance, kTolerance);
  }
}

/// A ball cut off at z = -4, which is a plane of the box.
const Box kCut{{-12, -12, -4}, {12, 12, 12}};
BodySurface cut_ball() { return {std::vector{ball_above(-4, kRadius, 48)}, kCut, kTolerance}; }

TEST(BodySurface, PointsOfTheBoxInsideACapAreInside) {
  const BodySurface ball = cut_ball();
  const double rim = std::sqrt(kRadius * kRadius - 16);
  for (const Vec3& p : random_points(500, {-11, -11, -4}, {11, 11, -4}, 5)) {
    const double depth = rim - std::hypot(p.x, p.y);
    if (std::abs(depth) < 0.06) continue;
    EXPECT_EQ(ball.material_at(p), depth > 0 ? 1 : kOutside) << p.x << ' ' << p.y;
  }
}

TEST(BodySurface, TheCapIsNoBorder) {
  const BodySurface ball = cut_ball();
  for (const Vec3& p : random_points(500, {-10, -10, -4}, {10, 10, -2}, 6)) {
    const BorderPoint border = ball.nearest_border(p);
    EXPECT_NEAR(norm(border.point), kRadius, 0.05);
    EXPECT_GE(border.point.z, -4);
  }
  // Nor does it count in the distance: only the round part does.
  const double rim = std::sqrt(kRadius * kRadius - 16);
  EXPECT_NEAR(ball.signed_distance(1, {0, 0, -4}), -rim, 0.05);
}

TEST(BodySurface, EdgesInThePlaneOfTheBoxCrossTheRim) {
  const BodySurface ball = cut_ball();
  const double rim = std::sqrt(kRadius * kRadius - 16);
  for (const double angle : {0.0, 0.4, 1.9, 3.3, 5.1}) {
    const Vec3 outside{11 * std::cos(angle), 11 * std::sin(angle), -4};
    EXPECT_NEAR(ball.crossing({0, 0, -4}, outside), rim / 11, 0.005);
  }
}

/// Cubes from 0 to 2 and from 1.5 to 3.5 along x.
TEST(BodySurface, WhereTwoOverlapAPointIsOfTheOneItLiesDeeperIn) {
  const std::vector surfaces{cube({0, 0, 0}, 2), cube({1.5, 0, 0}, 2)};
  const BodySurface shape(surfaces, {{-1, -1, -1}, {5, 3, 3}}, kTolerance);
  EXPECT_EQ(shape.material_at({1, 1, 1}), 1);
  EXPECT_EQ(shape.material_at({1.7, 1, 1}), 1);
  EXPECT_EQ(shape.material_at({1.8, 1, 1}), 2);
  EXPECT_EQ(shape.material_at({3, 1, 1}), 2);
  EXPECT_EQ(shape.material_at({-0.5, 1, 1}), kOutside);
  EXPECT_EQ(shape.material_at({3.6, 1, 1}), kOutside);
}

TEST(BodySurface, ToleranceIsLessWhereAWallOrAGapIsThin) {
  const std::vector wide{brick({{0, 0, 0}, {20, 20, 9}}, {10, 10, 3})};
  const std::vector thin{brick({{0, 0, 0}, {20, 20, 0.2}}, {10, 10, 1})};
  const std::vector gap{joined(brick({{0, 0, 0}, {20, 20, 9}}, {10, 10, 3}),
                               brick({{0, 0, 9.2}, {20, 20, 18}}, {10, 10, 3}))};
  const Box box{{-1, -1, -1}, {21, 21, 19}};
  const Vec3 middle{10.3, 10.2, 9};
  EXPECT_EQ(BodySurface(wide, box, kTolerance).nearest_border(middle).tolerance, kTolerance);
  const Vec3 within{10.3, 10.2, 0.15};  // of the thin wall; outward it has room
  EXPECT_LT(BodySurface(thin, box, kTolerance).nearest_border(within).tolerance, 0.2 / 4);
  EXPECT_EQ(BodySurface(thin, box, kTolerance).nearest_border(middle).tolerance, kTolerance);
  EXPECT_LT(BodySurface(gap, box, kTolerance).nearest_border(middle).tolerance, 0.2 / 4);
  EXPECT_GT(BodySurface(thin, box, kTolerance).nearest_border(within).tolerance, 0);
}

TEST(BodySurface, ThicknessIsThatOfTheWall) {
  const std::vector surfaces{brick({{0, 0, 0}, {20, 20, 2}}, {10, 10, 1})};
  const BodySurface plate(surfaces, {{-1, -1, -1}, {21, 21, 3}}, kTolerance);
  ASSERT_EQ(plate.thickness(1).size(), surfaces[0].points.size());
  for (std::size_t i = 0; i < surfaces[0].points.size(); ++i) {
    const Vec3& p = surfaces[0].points[i];
    if (p.x > 3 && p.x < 17 && p.y > 3 && p.y < 17) {
      EXPECT_NEAR(plate.thickness(1)[i], 2, 1e-9);
    }
  }
}

TEST(BodySurface, RefusesNothingAndTooMuch) {
  const Box box{{-1, -1, -1}, {2, 2, 2}};
  EXPECT_REFUSED(BodySurface({}, box, 0.1), HasSubstr("expected 1 to 255 objects, found 0"));
  const std::vector<TriMesh> many(256, cube());
  EXPECT_REFUSED(BodySurface(many, box, 0.1), HasSubstr("found 256"));
  const std::vector<TriMesh> hollow(1);
  EXPECT_REFUSED(BodySurface(hollow, box, 0.1), HasSubstr("expected triangles, found none"));
  // All of it lies on the box.
  EXPECT_REFUSED(BodySurface(std::vector{cube()}, {{0, 0, 0}, {1, 1, 1}}, 0.1),
                 HasSubstr("expected triangles, found none"));
}

}  // namespace
}  // namespace mesamis
