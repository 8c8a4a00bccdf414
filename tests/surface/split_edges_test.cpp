// SPDX-License-Identifier: Apache-2.0
#include "mesamis/surface/split_edges.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <set>

#include "mesamis/base/parallel.h"
#include "mesamis/surface/self_intersections.h"
#include "mesamis/surface/tri_mesh.h"
#include "support/shapes.h"

namespace mesamis {
namespace {

constexpr int kRounds = 30;  // enough for all

std::vector<double> edge_lengths(const TriMesh& surface) {
  std::vector<double> lengths;
  for (const Triangle& t : surface.triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      lengths.push_back(norm(surface.points[t[i]] - surface.points[t[(i + 1) % 3]]));
    }
  }
  return lengths;
}

double longest_edge(const TriMesh& surface) {
  const std::vector<double> lengths = edge_lengths(surface);
  return *std::max_element(lengths.begin(), lengths.end());
}

double shortest_edge(const TriMesh& surface) {
  const std::vector<double> lengths = edge_lengths(surface);
  return *std::min_element(lengths.begin(), lengths.end());
}

SplitRule longer_than(double longest) {
  return [longest](const Vec3& a, const Vec3& b) { return norm(a - b) > longest; };
}

TEST(SplitEdges, LeavesNoneThatTheRuleAsksForAndTheSurfaceWhereItIs) {
  for (const double longest : {2.0, 0.8, 0.3, 0.07}) {
    const TriMesh split = split_edges(cube(), longer_than(longest), {kRounds});
    EXPECT_LE(longest_edge(split), longest);
    const SurfaceCheck check = check_surface(split);
    EXPECT_EQ(check.open_edges + check.nonmanifold_edges + check.misoriented_edges, 0);
    EXPECT_NEAR(check.area, 6, 1e-12);
    EXPECT_NEAR(check.volume, 1, 1e-12);
    EXPECT_TRUE(find_self_intersections(split).empty());
  }
}

TEST(SplitEdges, SplitsOnlyWhereTheRuleAsks) {
  // Edges near one corner of the cube only: triangles with one and two split edges come about.
  const TriMesh split = split_edges(
      cube(),
      [](const Vec3& a, const Vec3& b) { return norm(a - b) > 0.2 && norm(0.5 * (a + b)) < 0.6; },
      {kRounds});
  EXPECT_GT(split.triangles.size(), 12u);
  const SurfaceCheck check = check_surface(split);
  EXPECT_EQ(check.open_edges + check.nonmanifold_edges + check.misoriented_edges, 0);
  EXPECT_NEAR(check.volume, 1, 1e-12);
  EXPECT_LT(split.triangles.size(),
            split_edges(cube(), longer_than(0.2), {kRounds}).triangles.size() / 2);
}

TEST(SplitEdges, EndsAfterItsRounds) {
  const auto always = [](const Vec3&, const Vec3&) { return true; };
  EXPECT_EQ(split_edges(cube(), always, {0}).triangles, cube().triangles);
  EXPECT_EQ(split_edges(cube(), always, {1}).triangles.size(), 24u);
  EXPECT_GT(split_edges(cube(), always, {3}).triangles.size(), 60u);
}

TEST(SplitEdges, AsksOnceOfEachEdge) {
  const auto rule = longer_than(0.2);
  std::set<std::array<double, 6>> asked;
  const SplitRule once = [&](const Vec3& a, const Vec3& b) {
    EXPECT_TRUE(asked.insert({a.x, a.y, a.z, b.x, b.y, b.z}).second);
    return rule(a, b);
  };
  const TriMesh split = with_threads(1, [&] { return split_edges(cube(), once, {kRounds}); });
  EXPECT_EQ(split.triangles, split_edges(cube(), rule, {kRounds}).triangles);
}

TEST(SplitEdges, LeavesTheOthersAlone) {
  const TriMesh before = cube();
  const TriMesh after = split_edges(before, longer_than(2), {kRounds});
  EXPECT_EQ(after.triangles, before.triangles);
  EXPECT_EQ(after.points.size(), before.points.size());
}

TEST(SplitEdges, SameBitsForAnyNumberOfThreads) {
  const auto split = [] { return split_edges(cube(), longer_than(0.05), {kRounds}); };
  const TriMesh one = with_threads(1, split), three = with_threads(3, split);
  EXPECT_EQ(one.triangles, three.triangles);
}

// A corner just beside the middle of an edge: cut once, its triangle would have an edge of nothing.
TEST(SplitEdges, LeavesTrianglesThatAreThinAlready) {
  TriMesh surface = cube();
  const Triangle thin = add_thin_triangle(surface, 0.01);
  const TriMesh cut = split_edges(surface, longer_than(0.3), {kRounds});
  EXPECT_LT(shortest_edge(cut), 0.011);
  const TriMesh left = split_edges(surface, longer_than(0.3), {kRounds, 0.02});
  EXPECT_GT(shortest_edge(left), 4 * shortest_edge(cut));
  EXPECT_EQ(std::count(left.triangles.begin(), left.triangles.end(), thin), 1);
  EXPECT_GT(left.triangles.size(), 100u) << "others are split";
  EXPECT_EQ(flaws_of(check_surface(left)), "");
}

TEST(SplitEdges, LeavesEdgesBetweenHeldPoints) {
  const TriMesh before = cube();
  std::vector<char> held(before.points.size(), 0);
  held[before.triangles[0][0]] = held[before.triangles[0][1]] = held[before.triangles[0][2]] = 1;
  const TriMesh after = split_edges(before, [](const Vec3&, const Vec3&) { return true; },
                                    {.rounds = 4, .held = held});
  EXPECT_EQ(flaws_of(check_surface(after)), "");
  EXPECT_EQ(std::count(after.triangles.begin(), after.triangles.end(), before.triangles[0]), 1);
  EXPECT_EQ(after.triangles[0], before.triangles[0]) << "in the order of what they are parts of";
  EXPECT_GT(after.triangles.size(), 8 * before.triangles.size());
}

}  // namespace
}  // namespace mesamis
