// SPDX-License-Identifier: Apache-2.0
#include "mesamis/body/size_field.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "mesamis/base/parallel.h"
#include "support/solids.h"
#include "surface/random_surfaces.h"

namespace mesamis {
namespace {

constexpr double kThick = std::numeric_limits<double>::infinity();

/// Where nothing but the target and the least size count.
SizeRules coarse() {
  SizeRules rules;
  rules.target = 3;
  rules.least = 0.1;
  return rules;
}

std::vector<double> sizes_of(const TriMesh& surface, const SizeRules& rules,
                             double thickness = kThick) {
  return surface_sizes(surface, std::vector<double>(surface.points.size(), thickness), rules);
}

/// Of a brick from 0 to 20: two rings of triangles away from its edges.
bool is_central(const Vec3& p) { return p.x > 5 && p.x < 15 && p.y > 5 && p.y < 15; }
TriMesh slab(double thickness) { return brick({{0, 0, 0}, {20, 20, thickness}}, {20, 20, 4}); }

TEST(SurfaceSizes, AreTheTargetOnAFlatFace) {
  const TriMesh surface = slab(20);
  const auto sizes = sizes_of(surface, coarse());
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    if (is_central(surface.points[i])) {
      EXPECT_EQ(sizes[i], 3);
    }
  }
}

TEST(SurfaceSizes, OnABallGoWithTheRootOfItsRadius) {
  SizeRules rules = coarse();
  rules.target = 20;
  for (const double radius : {2.0, 10.0, 40.0}) {
    for (const double size : sizes_of(ball_surface(radius, 40), rules)) {
      const double expected = std::sqrt(6 * rules.tolerance * radius);
      EXPECT_GT(size, 0.7 * expected);
      EXPECT_LT(size, 1.4 * expected);
    }
  }
}

TEST(SurfaceSizes, OnABallDoNotDependOnItsTriangles) {
  SizeRules rules = coarse();
  rules.target = 20;
  const auto few = sizes_of(ball_surface(10, 24), rules),
             many = sizes_of(ball_surface(10, 96), rules);
  const auto mean = [](const std::vector<double>& sizes) {
    double sum = 0;
    for (const double size : sizes) sum += size;
    return sum / static_cast<double>(sizes.size());
  };
  EXPECT_NEAR(mean(few) / mean(many), 1, 0.15);
}

TEST(SurfaceSizes, FitTheWall) {
  const TriMesh surface = slab(2);
  SizeRules rules = coarse();
  for (const int through : {1, 2, 4}) {
    rules.through_wall = through;
    const auto sizes = sizes_of(surface, rules, 2);
    for (std::size_t i = 0; i < sizes.size(); ++i) {
      if (is_central(surface.points[i])) {
        EXPECT_DOUBLE_EQ(sizes[i], 2.0 / through);
      }
    }
  }
  rules.through_wall = 0;
  const auto sizes = sizes_of(surface, rules, 2);
  EXPECT_EQ(*std::max_element(sizes.begin(), sizes.end()), 3);
}

TEST(SurfaceSizes, AreNeverBelowTheLeast) {
  SizeRules rules = coarse();
  rules.least = 1.5;
  rules.tolerance = 1e-4;
  for (const double size : sizes_of(ball_surface(5, 24), rules, 0.01)) EXPECT_EQ(size, 1.5);
}

double size_at(const MetricField& field, const Vec3& p) {
  Index hint = 0;
  return 1 / std::sqrt(field.at(p, hint).xx);
}

/// A slab with a thin plate that stands on it: small sizes at the plate, large ones below.
struct Scene {
  std::vector<TriMesh> surfaces{slab(20), brick({{0, 0, 24}, {20, 20, 24.8}}, {20, 20, 1})};
  Box box{{-4, -4, -4}, {24, 24, 28}};
  BodySurface shape{surfaces, box, 0.1};
  SizeRules rules = coarse();
  GridMetricField field = size_field(surfaces, shape, box, rules);
};

TEST(SizeField, IsIsotropic) {
  const Scene scene;
  Index hint = 0;
  for (const Vec3& p : random_points(200, scene.box.lo, scene.box.hi, 1)) {
    const Sym3 m = scene.field.at(p, hint);
    EXPECT_NEAR(m.yy, m.xx, 1e-6 * m.xx);
    EXPECT_NEAR(m.zz, m.xx, 1e-6 * m.xx);
    EXPECT_NEAR(std::abs(m.xy) + std::abs(m.xz) + std::abs(m.yz), 0, 1e-6 * m.xx);
  }
}

TEST(SizeField, IsTheTargetDeepInsideAndTheWallsAtAWall) {
  const Scene scene;
  EXPECT_NEAR(size_at(scene.field, {10, 10, 10}), 3, 1e-5);
  EXPECT_NEAR(size_at(scene.field, {10, 10, 24.4}), 0.8, 0.05);
}

TEST(SizeField, IsNeverBelowTheLeastNorAboveTheTargetInside) {
  const Scene scene;
  for (const Vec3& p : random_points(2000, scene.box.lo, scene.box.hi, 2)) {
    const double size = size_at(scene.field, p);
    EXPECT_GE(size, scene.rules.least * (1 - 1e-5));
    if (p.z > 0.5 && p.z < 19.5 && is_central(p)) {
      EXPECT_LE(size, 3 * (1 + 1e-5));
    }
  }
}

TEST(SizeField, GrowsNoFasterThanTheGradation) {
  Scene scene;
  scene.rules.gradation = 0.2;
  scene.rules.tolerance = 0.01;  // sharp edges ask for small sizes
  const auto field = size_field(scene.surfaces, scene.shape, scene.box, scene.rules);
  // As far from the surface as a brick of the grid is wide: outside sizes grow faster.
  const auto from = random_points(4000, {2, 2, 2}, {18, 18, 18}, 3);
  const auto step = random_points(4000, {-1, -1, -1}, {1, 1, 1}, 4);
  double steepest = 0;
  for (std::size_t i = 0; i < from.size(); ++i) {
    const Vec3 way = 0.25 * unit_or_zero(step[i]);
    const double growth = (size_at(field, from[i] + way) - size_at(field, from[i])) / norm(way);
    steepest = std::max(steepest, growth);
    // Between its nodes the field is not as smooth: along the diagonal of a brick.
    EXPECT_LE(growth, 0.2 * std::sqrt(3.0) * 1.05);
  }
  EXPECT_GT(steepest, 0.1);
}

TEST(SizeField, IsTheSameForAnyNumberOfThreads) {
  const Scene scene;
  const auto points = random_points(500, scene.box.lo, scene.box.hi, 5);
  auto sizes = [&] {
    return sample(size_field(scene.surfaces, scene.shape, scene.box, scene.rules), points);
  };
  const auto once = with_threads(1, sizes);
  EXPECT_EQ(with_threads(4, sizes), once);
}

/// Around a wanted size the field grows with the gradation; far away it is as before.
TEST(RefinedSizes, AreSmallWhereWantedAndNowhereElse) {
  const Box box{{0, 0, 0}, {20, 20, 20}};
  constexpr std::size_t kNodes = 8;
  const float log = -2 * std::log(3.0F);
  const detail::mesh::GridMetricField sizes(
      box, {2, 2, 2}, std::vector(kNodes, std::array{log, 0.0F, 0.0F, log, 0.0F, log}));
  const detail::body::WantedSize place{{10, 10, 10}, 0.5};
  const auto finer = detail::body::refined(sizes, box, {&place, 1}, coarse());
  Index hint = 0;
  const auto at = [&](double x) { return detail::body::size_at(finer, {x, 10, 10}, hint); };
  EXPECT_NEAR(at(10), 0.5, 1e-3);
  for (const double away : {1.0, 2.0, 4.0}) {
    EXPECT_LT(at(10 + away), 0.5 + coarse().gradation * away + 1e-3);
    EXPECT_GT(at(10 + away), 0.5 + coarse().gradation * (away - 1) - 1e-3);
  }
  EXPECT_NEAR(at(16.5), 3, 1e-3);
  EXPECT_NEAR(at(1), 3, 1e-3);
}

}  // namespace
}  // namespace mesamis
