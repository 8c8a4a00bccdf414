// SPDX-License-Identifier: Apache-2.0
#include "mesamis/surface/crease_normals.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/shapes.h"

namespace mesamis {
namespace {

Vec3 flat_normal(const TriMesh& surface, std::size_t t) {
  const auto at = [&](std::size_t n) {
    return surface.points[static_cast<std::size_t>(surface.triangles[t][n])];
  };
  return unit_or_zero(cross(at(1) - at(0), at(2) - at(0)));
}

TEST(CreaseNormals, OfACubeAreThoseOfItsFaces) {
  const TriMesh surface = cube();
  const auto normals = crease_normals(surface, 40);
  ASSERT_EQ(normals.size(), surface.triangles.size());
  for (std::size_t t = 0; t < normals.size(); ++t) {
    for (const Vec3& n : normals[t]) {
      EXPECT_NEAR(norm(n - flat_normal(surface, t)), 0, 1e-12);
    }
  }
}

TEST(CreaseNormals, OfACubeWithoutSharpEdgesAreOnePerPoint) {
  const TriMesh surface = cube();
  const auto normals = crease_normals(surface, 180);
  std::vector<Vec3> of_point(surface.points.size());
  for (std::size_t t = 0; t < normals.size(); ++t) {
    for (std::size_t n = 0; n < 3; ++n) {
      Vec3& first = of_point[static_cast<std::size_t>(surface.triangles[t][n])];
      if (norm(first) == 0) first = normals[t][n];
      EXPECT_NEAR(norm(first - normals[t][n]), 0, 1e-12);
      EXPECT_NEAR(norm(normals[t][n]), 1, 1e-12);
    }
  }
}

/// Two squares that meet at 30 degrees are smooth at a limit of 40 and sharp at one of 20.
TEST(CreaseNormals, HeedTheAngle) {
  const double c = std::cos(M_PI / 6), s = std::sin(M_PI / 6);
  const TriMesh roof{{{0, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {-1, 1, 0}, {c, 0, -s}, {c, 1, -s}},
                     {{2, 0, 3}, {0, 1, 3}, {0, 4, 1}, {4, 5, 1}}};
  const auto smooth = crease_normals(roof, 40), sharp = crease_normals(roof, 20);
  EXPECT_NEAR(norm(smooth[1][0] - smooth[2][0]), 0, 1e-12) << "at the ridge";
  EXPECT_GT(norm(sharp[1][0] - sharp[2][0]), 0.5);
  EXPECT_NEAR(smooth[0][0].z, 1, 1e-12) << "away from it";
}

TEST(CreaseNormals, OfNoTrianglesOrNoAreaAreNone) {
  EXPECT_TRUE(crease_normals({}, 40).empty());
  const TriMesh line{{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {{0, 1, 2}}};
  EXPECT_EQ(crease_normals(line, 40)[0][1], (Vec3{0, 0, 0}));
}

}  // namespace
}  // namespace mesamis
