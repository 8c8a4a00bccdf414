// SPDX-License-Identifier: Apache-2.0
#include "mesamis/method/surface_change.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "mesamis/mesh/tet_mesh.h"

namespace mesamis {
namespace {

/// A field of the nodes.
template <class Function>
std::vector<double> sampled(const TetMesh& mesh, Function&& f) {
  std::vector<double> values;
  for (const Vec3& p : mesh.points) values.push_back(f(p));
  return values;
}

const TetMesh& mesh() {
  static const TetMesh kMesh = box_mesh({{0, 0, 0}, {10, 10, 10}}, {9, 9, 9});
  return kMesh;
}

TEST(SurfaceChange, IsTheDistanceOfShiftedPlanes) {
  const auto plane = [](double at) {
    return sampled(mesh(), [at](const Vec3& p) { return 7 * (0.6 * p.x + 0.8 * p.y - at); });
  };
  for (const double shift : {0.0, 0.3, -0.7}) {
    EXPECT_NEAR(level_set_change(mesh(), plane(6.1 + shift), plane(6.1), {0, 5}), std::abs(shift),
                1e-12);
  }
  EXPECT_NEAR(level_set_change(mesh(), plane(8), plane(6.1), {0, 0.5}), 0.5, 1e-12)
      << "no more than the longest that counts";
}

TEST(SurfaceChange, OfASphereThatGrows) {
  const auto sphere = [](double radius) {
    return sampled(mesh(), [=](const Vec3& p) { return radius - norm(p - Vec3{5, 5, 5}); });
  };
  EXPECT_NEAR(level_set_change(mesh(), sphere(3.2), sphere(3), {0, 5}), 0.2, 0.01);
}

TEST(SurfaceChange, IsWeightedByArea) {
  // Two planes; the one across x moves by 0.4, on half of the area.
  const auto planes = [](double at) {
    return sampled(mesh(), [at](const Vec3& p) { return p.x < 5 ? p.x - at : 8.2 - p.x; });
  };
  EXPECT_NEAR(level_set_change(mesh(), planes(2.6), planes(2.2), {0, 5}), 0.2, 0.02);
}

TEST(SurfaceChange, OfNothingIsZero) {
  const auto flat = sampled(mesh(), [](const Vec3&) { return 1; });
  EXPECT_EQ(level_set_change(mesh(), flat, flat, {0, 5}), 0);
  const auto plane = sampled(mesh(), [](const Vec3& p) { return p.x - 5.1; });
  EXPECT_EQ(level_set_change(mesh(), plane, flat, {0, 5}), 5) << "it has gone";
}

}  // namespace
}  // namespace mesamis
