// SPDX-License-Identifier: Apache-2.0
#include "mesamis/decimate/decimate_pass.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <set>
#include <utility>

#include "mesamis/decimate/flip.h"
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
      : task{surface, tolerance, triangles, [](double) {}} {}
  TriMesh run(const std::vector<char>& held) const {
    std::vector<Patch> one = cut_into_patches(cover_of(surface), kInfinity);
    one[0].held = held;
    Cover cover = decimate_pass(task, one[0]);
    return {std::move(cover.points), std::move(cover.triangles)};
  }
  std::vector<char> none() const { return std::vector<char>(surface.points.size(), 0); }

  TriMesh surface = torus();
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

/// Waves of all directions make folds that run across the edges of the grid.
TEST(DecimatePass, LeavesFewEdgesToFlip) {
  Pass pass(0.05);
  for (Vec3& p : pass.surface.points) {
    p = (1 + 0.03 * std::sin(23 * p.x + 17 * p.y) * std::cos(19 * p.z - 7 * p.y)) * p;
  }
  const TriMesh result = pass.run(pass.none());
  EXPECT_EQ(flaws_of(check_surface(result)), "");
  const EditableSurface surface(result.points.size(), result.triangles);
  std::vector<Vec3> normals;
  for (const Triangle& t : result.triangles) normals.push_back(unit_normal(corners_of(result, t)));
  double edges = 0, flips = 0;
  for (Index h = 0; h < 3 * surface.count(); ++h) {
    if (surface.opposite(h) < h || !surface.may_flip(h)) continue;
    ++edges;
    if (smooths(surface, result.points, normals, describe_flip(surface, result.points, h))) ++flips;
  }
  EXPECT_LT(flips, 0.05 * edges);
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
  const TriMesh result = pass.run(held);
  for (const Triangle& t : result.triangles) used.insert(t.begin(), t.end());
  std::size_t others = 0;
  for (std::size_t p = 0; p < held.size(); ++p) {
    const bool is_used = used.count(static_cast<Index>(p)) != 0;
    if (held[p]) {
      EXPECT_TRUE(is_used) << p;
      EXPECT_EQ(result.points[p], pass.surface.points[p]);
    }
    others += is_used && !held[p];
  }
  EXPECT_LT(others, held.size() / 4);
}

TEST(DecimatePass, KeepsARimAndWhatItStandsFor) {
  const Pass whole(0.02);
  for (const Patch& patch : cut_into_patches(cover_of(whole.surface), 0.5)) {
    const Cover done = decimate_pass(whole.task, patch);
    std::set<Triangle> left(done.triangles.begin(), done.triangles.end());
    for (const Triangle& t : patch.cover.triangles) {
      const bool is_held = patch.held[t[0]] + patch.held[t[1]] + patch.held[t[2]] == 3;
      EXPECT_TRUE(!is_held || left.count(t) == 1);
    }
    std::set<Index> before, after;
    for (const auto& some : patch.cover.originals) before.insert(some.begin(), some.end());
    for (const auto& some : done.originals) {
      EXPECT_TRUE(std::is_sorted(some.begin(), some.end()));
      after.insert(some.begin(), some.end());
    }
    EXPECT_EQ(after, before);
  }
}

TEST(DecimatePass, WithAllPointsHeldChangesNothing) {
  const Pass pass(0.1);
  const TriMesh result = pass.run(std::vector<char>(pass.surface.points.size(), 1));
  EXPECT_EQ(result.triangles, pass.surface.triangles);
  EXPECT_EQ(result.points, pass.surface.points);
}

}  // namespace
}  // namespace mesamis
