// SPDX-License-Identifier: Apache-2.0
#include "mesamis/decimate/decimate_pass.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>
#include <set>

#include "mesamis/surface/distance.h"
#include "mesamis/surface/farthest.h"
#include "mesamis/surface/self_intersections.h"
#include "mesamis/surface/unused_points.h"
#include "support/level_set.h"

namespace mesamis {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

TriMesh torus() {
  return level_set({{-1, -1, -0.5}, {1, 1, 0.5}}, {20, 20, 10}, [](const Vec3& p) {
    const double r = std::hypot(p.x, p.y) - 0.6;
    return 0.25 - std::hypot(r, p.z);
  });
}

struct Pass {
  explicit Pass(double tolerance, std::int64_t triangles = 0)
      : tree(surface), task{surface, {&tree, 1}, tolerance, triangles, [](double) {}} {}
  TriMesh run(const std::vector<char>& held) const {
    std::vector<Patch> one = cut_into_patches(surface.points, cover_of(surface), kInfinity);
    one[0].held = held;
    return {surface.points, decimate_pass(task, one[0]).triangles};
  }
  std::vector<char> none() const { return std::vector<char>(surface.points.size(), 0); }

  TriMesh surface = torus();
  TriangleTree tree;
  DecimateTask task;
};

TEST(DecimatePass, StaysNearClosedAndFreeOfIntersections) {
  const Pass pass(0.02);
  const TriMesh result = pass.run(pass.none());
  const SurfaceCheck check = check_surface(result);
  EXPECT_EQ(flaws_of(check), "");
  EXPECT_EQ(check.components, 1);
  EXPECT_LT(result.triangles.size(), pass.surface.triangles.size() / 3);
  EXPECT_TRUE(find_self_intersections(result).empty());
  EXPECT_LE(max_distance(result, pass.surface, 1e-4), 0.02 * kDistanceSlack);
}

TEST(DecimatePass, StopsAtANumberOfTriangles) {
  const Pass pass(kInfinity, 600);
  const auto triangles = pass.run(pass.none()).triangles.size();
  EXPECT_LE(triangles, 600u);
  EXPECT_GE(triangles, 599u);  // a collapse takes two
}

TEST(DecimatePass, KeepsThePointsHeld) {
  const Pass pass(kInfinity, 200);
  std::vector<char> held = pass.none();
  std::mt19937 generator(1);
  for (char& h : held) h = generator() % 10 == 0;
  std::set<Index> used;
  for (const Triangle& t : pass.run(held).triangles) used.insert(t.begin(), t.end());
  std::size_t others = 0;
  for (std::size_t p = 0; p < held.size(); ++p) {
    const bool is_used = used.count(static_cast<Index>(p)) != 0;
    if (held[p]) {
      EXPECT_TRUE(is_used) << p;
    }
    others += is_used && !held[p];
  }
  EXPECT_LT(others, held.size() / 4);
}

TEST(DecimatePass, WithAllPointsHeldChangesNothing) {
  const Pass pass(0.1);
  const TriMesh result = pass.run(std::vector<char>(pass.surface.points.size(), 1));
  // OpenMesh may begin a triangle at another corner.
  auto sorted = [](std::vector<Triangle> triangles) {
    for (Triangle& t : triangles) {
      std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
    }
    return triangles;
  };
  EXPECT_EQ(sorted(result.triangles), sorted(pass.surface.triangles));
}

}  // namespace
}  // namespace mesamis
