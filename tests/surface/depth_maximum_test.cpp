// SPDX-License-Identifier: Apache-2.0
#include "mesamis/surface/depth_maximum.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "mesamis/surface/normals.h"
#include "support/level_set.h"
#include "support/shapes.h"
#include "support/throws.h"

namespace mesamis {
namespace {

const Box kBox{{-1, -1, -1}, {1, 1, 1}};

std::vector<double> at_nodes(const TetMesh& mesh, const std::function<double(const Vec3&)>& f) {
  std::vector<double> u;
  for (const Vec3& p : mesh.points) u.push_back(f(p));
  return u;
}

TEST(MaxBelowSurface, OfALinearFunctionLiesAtOneEndOfTheWay) {
  const TetMesh mesh = box_mesh(kBox, {5, 6, 7});
  const auto u = at_nodes(mesh, [](const Vec3& p) { return 3 * p.x - p.z + 2; });
  const TriMesh ball = level_set(kBox, {9, 9, 9}, [](const Vec3& p) { return 0.7 - norm(p); });
  const auto normals = vertex_normals(ball);
  const auto greatest = max_below_surface(mesh, u, ball, {0.5, 4});
  ASSERT_EQ(greatest.size(), ball.points.size());
  for (std::size_t n = 0; n < greatest.size(); ++n) {
    const Vec3 &p = ball.points[n], inner = p - 0.5 * normals[n];
    const double expected = std::max(3 * p.x - p.z, 3 * inner.x - inner.z) + 2;
    EXPECT_NEAR(greatest[n], expected, 1e-12);
  }
}

TEST(MaxBelowSurface, FindsAThinLayerOnTheWayThrough) {
  const TetMesh mesh = box_mesh(kBox, {40, 40, 40});
  const auto u = at_nodes(mesh, [](const Vec3& p) { return std::abs(norm(p) - 0.55) < 0.08; });
  const TriMesh ball = level_set(kBox, {9, 9, 9}, [](const Vec3& p) { return 0.7 - norm(p); });
  for (const double g : max_below_surface(mesh, u, ball, {0.4, 8})) EXPECT_GT(g, 0.9);
  for (const double g : max_below_surface(mesh, u, ball, {0, 1})) EXPECT_LT(g, 0.7);
}

TEST(MaxBelowSurface, BeyondTheMeshTheNearestCellAnswers) {
  const TetMesh mesh = box_mesh(kBox, {2, 2, 2});
  const auto u = at_nodes(mesh, [](const Vec3& p) { return p.x; });
  for (const double g : max_below_surface(mesh, u, cube({4, 0, 0}), {0.5, 2}))
    EXPECT_NEAR(g, 1, 1e-12);
}

TEST(MaxBelowSurface, RefusesValuesThatAreNotOnePerNode) {
  const TetMesh mesh = box_mesh(kBox, {1, 1, 1});
  EXPECT_REFUSED(max_below_surface(mesh, std::vector<double>(7), cube(), {1, 1}),
                 testing::HasSubstr("7 values for 8 nodes"));
  EXPECT_REFUSED(max_below_surface(mesh, std::vector<double>(8), cube(), {-1, 1}),
                 testing::HasSubstr("0 mm or more, found -1"));
  EXPECT_REFUSED(max_below_surface(mesh, std::vector<double>(8), cube(), {1, 0}),
                 testing::HasSubstr("at least 1 sample, found 0"));
}

}  // namespace
}  // namespace mesamis
