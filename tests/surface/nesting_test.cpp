// SPDX-License-Identifier: Apache-2.0
#include "mesamis/surface/nesting.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "mesamis/mesh/tet_mesh.h"
#include "support/level_set.h"
#include "surface/nested_cubes.h"

namespace mesamis {
namespace {

TEST(Nesting, KnowsWhatLiesInWhat) {
  const TriMesh surface = nested();
  const SurfaceComponents parts = find_components(surface);
  const Nesting nesting = find_nesting(surface, parts);
  // Largest first: 1000, -216, 27, 8, -1, 0.125.
  EXPECT_EQ(nesting.depth, (std::vector<int>{0, 1, 0, 2, 3, 0}));
  EXPECT_EQ(nesting.parent, (std::vector<Index>{kNoIndex, 0, kNoIndex, 1, 3, kNoIndex}));
}

/// Rays that meet edges and corners are counted right: all on one lattice.
TEST(Nesting, HoldsWhereRaysMeetEdgesAndPoints) {
  TriMesh surface = cube({0, 0, 0}, 64);
  int inside = 0;
  for (int k = 0; k < 4; ++k) {
    for (int j = 0; j < 4; ++j) {
      for (int i = 0; i < 4; ++i, ++inside) {
        surface = joined(surface, turned(cube({4.0 + 16 * i, 4.0 + 16 * j, 4.0 + 16 * k}, 8)));
      }
    }
  }
  const Nesting nesting = find_nesting(surface, find_components(surface));
  EXPECT_EQ(nesting.depth[0], 0);
  for (std::size_t p = 1; p < nesting.depth.size(); ++p) {
    EXPECT_EQ(nesting.depth[p], 1);
    EXPECT_EQ(nesting.parent[p], 0);
  }
}

struct Ball {
  Vec3 center;
  double radius;
};

/// Triangles with corners on the sphere: they lie inside it.
TriMesh sphere(const Ball& ball) {
  static const TriMesh unit = [] {
    TriMesh mesh = level_set({{-1, -1, -1}, {1, 1, 1}}, {8, 8, 8},
                             [](const Vec3& p) { return 0.8 - norm(p); });
    for (Vec3& p : mesh.points) p = (1 / norm(p)) * p;
    return mesh;
  }();
  TriMesh mesh = unit;
  for (Vec3& p : mesh.points) p = ball.center + ball.radius * p;
  return mesh;
}

/// Their least distance from the centre is above this share of the radius.
constexpr double kInner = 0.85;

bool contains(const Ball& outer, const Ball& inner) {
  return norm(outer.center - inner.center) + inner.radius < kInner * outer.radius;
}
bool apart(const Ball& a, const Ball& b) { return norm(a.center - b.center) > a.radius + b.radius; }

/// Balls of radii from 1 to 1e-3 that contain each other or are apart.
std::vector<Ball> random_balls(std::size_t count) {
  std::mt19937 generator(7);
  std::uniform_real_distribution<double> uniform(-0.6, 0.6), exponent(-1.2, -0.2);
  std::vector<Ball> balls{{{0, 0, 0}, 1.5}};
  while (balls.size() < count) {
    const Ball& parent = balls[generator() % balls.size()];
    const Vec3 shift{uniform(generator), uniform(generator), uniform(generator)};
    const Ball next{parent.center + parent.radius * shift,
                    parent.radius * std::pow(10, exponent(generator))};
    const bool fits =
        next.radius > 1e-3 && std::all_of(balls.begin(), balls.end(), [&](const Ball& other) {
          return contains(other, next) || contains(next, other) || apart(other, next);
        });
    if (fits) balls.push_back(next);
  }
  return balls;
}

/// Smallest ball around ball b, or its own index.
std::size_t parent_of(const std::vector<Ball>& balls, std::size_t b) {
  std::size_t parent = b;
  for (std::size_t i = 0; i < balls.size(); ++i) {
    if (!contains(balls[i], balls[b])) continue;
    if (parent == b || balls[i].radius < balls[parent].radius) parent = i;
  }
  return parent;
}

TEST(Nesting, OfSpheresIsThatOfTheirCentresAndRadii) {
  std::vector<Ball> balls = random_balls(120);
  std::sort(balls.begin(), balls.end(),  // find_components() puts the largest first
            [](const Ball& a, const Ball& b) { return a.radius > b.radius; });
  TriMesh surface;
  for (const Ball& ball : balls) surface = joined(surface, sphere(ball));
  const Nesting nesting = find_nesting(surface, find_components(surface));
  ASSERT_EQ(nesting.parent.size(), balls.size());
  int deepest = 0;
  for (std::size_t b = 0; b < balls.size(); ++b) {
    const std::size_t parent = parent_of(balls, b);
    EXPECT_EQ(nesting.parent[b], parent == b ? kNoIndex : static_cast<Index>(parent)) << b;
    EXPECT_EQ(nesting.depth[b],
              std::count_if(balls.begin(), balls.end(),
                            [&](const Ball& other) { return contains(other, balls[b]); }))
        << b;
    deepest = std::max(deepest, nesting.depth[b]);
  }
  EXPECT_GE(deepest, 3);
}

TEST(Nesting, OfNothingIsEmpty) {
  EXPECT_TRUE(find_nesting({}, find_components({})).depth.empty());
}

}  // namespace
}  // namespace mesamis
