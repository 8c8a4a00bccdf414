// SPDX-License-Identifier: Apache-2.0
#include "mesamis/report/meshing_surface.h"

#include <gmock/gmock.h>

#include <cmath>

#include "mesamis/base/error.h"
#include "support/solids.h"
#include "support/throws.h"

namespace mesamis {
namespace {

using testing::HasSubstr;

constexpr MeshingQuality kKept{{20, 0.99}, 0.2, 0.2, 0.2, 0};

TEST(MeshingSurface, ThePromiseIsKeptUpToItsBounds) { EXPECT_EQ(unmet(kKept), ""); }

TEST(MeshingSurface, EachMissedPromiseIsNamed) {
  MeshingQuality q = kKept;
  q.triangles.least_angle = 12.25;
  EXPECT_EQ(unmet(q), "a least angle of 12.2 degrees, expected 20");
  q = kKept;
  q.triangles.share_above_30_deg = 0.98;
  EXPECT_EQ(unmet(q), "98 % of the triangles above 30 degrees, expected 99 %");
  q = kKept;
  q.to_given = 0.25;
  EXPECT_EQ(unmet(q), "a distance of 0.25 mm, expected 0.2 mm");
  q.self_intersections = 3;
  EXPECT_THAT(unmet(q), HasSubstr("expected 0.2 mm; 3 pairs of triangles that meet, expected 0"));
  q = kKept;
  q.from_given = 0.3;
  EXPECT_THAT(unmet(q), HasSubstr("0.3 mm"));
}

TEST(MeshingSurface, DistancesAreMeasuredBothWays) {
  const TriMesh ball = ball_surface(8, 32);
  TriMesh two = ball;  // and a second one, 5 mm from the first
  const TriMesh other = moved(ball_surface(2, 12), {15, 0, 0});
  const auto offset = static_cast<Index>(two.points.size());
  two.points.insert(two.points.end(), other.points.begin(), other.points.end());
  for (const Triangle& t : other.triangles) {
    two.triangles.push_back({t[0] + offset, t[1] + offset, t[2] + offset});
  }
  const MeshingQuality quality = meshing_quality(ball, two, 0.1);
  EXPECT_LE(quality.to_given, 0.01 * 0.1) << "parts nearer than that are not told apart";
  EXPECT_NEAR(quality.from_given, 9, 0.05) << "the far side of the second one";
  EXPECT_EQ(quality.tolerance, 0.1);
  EXPECT_EQ(quality.self_intersections, 0);
  EXPECT_EQ(quality.triangles.least_angle, triangle_shapes(ball).least_angle);
}

TEST(MeshingSurface, ASurfaceThatMeetsItselfIsFound) {
  TriMesh ball = ball_surface(8, 16);
  const TriMesh given = ball;
  ball.points[0] = -2.0 * ball.points[0];  // through the other side
  EXPECT_GT(meshing_quality(ball, given, 0.1).self_intersections, 0);
}

TEST(MeshingSurface, WithoutTrianglesItIsRefused) {
  EXPECT_REFUSED(meshing_quality({}, ball_surface(8, 16), 0.1), HasSubstr("triangle"));
}

/// A linear field on a plane triangle comes over exactly, with the distance added.
TEST(MeshingSurface, ErrorsComeOverWithTheDistance) {
  const TriMesh tetrahedron{{{0, 0, 0}, {6, 0, 0}, {0, 6, 0}, {0, 0, 6}},
                            {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};
  const std::vector<double> errors{1, 7, 13, 1};  // 1 + x + 2 y where z is 0
  const auto carried = carried_errors(tetrahedron, errors, {{1, 2, 0}, {1, 2, -0.5}, {6, 0, 0}});
  EXPECT_NEAR(carried[0], 6, 1e-12);
  EXPECT_NEAR(carried[1], std::hypot(6, 0.5), 1e-12);
  EXPECT_NEAR(carried[2], 7, 1e-12);
}

TEST(MeshingSurface, WhereNothingIsExpectedNothingIsAdded) {
  const TriMesh ball = ball_surface(8, 16);
  const auto carried =
      carried_errors(ball, std::vector<double>(ball.points.size(), 0), {{0, 0, 8.25}});
  EXPECT_EQ(carried[0], 0);
}

}  // namespace
}  // namespace mesamis
