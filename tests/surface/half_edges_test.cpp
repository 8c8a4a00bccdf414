// SPDX-License-Identifier: Apache-2.0
#include "mesamis/surface/half_edges.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>
#include <set>
#include <utility>
#include <vector>

#include "support/shapes.h"

namespace mesamis {
namespace {

/// Triangles over few points: edges with many triangles, repeated triangles, repeated corners.
std::vector<Triangle> crowded_triangles(std::size_t count, Index points) {
  std::mt19937 generator(1);
  std::uniform_int_distribution<Index> point(0, points - 1);
  std::vector<Triangle> triangles;
  for (std::size_t t = 0; t < count; ++t) {
    triangles.push_back({point(generator), point(generator), point(generator)});
  }
  return triangles;
}

using Edge = std::pair<Index, Index>;

/// Each edge with its triangles, those without area left out.
std::map<Edge, std::vector<Index>> triangles_of_edges(const std::vector<Triangle>& triangles) {
  std::map<Edge, std::vector<Index>> edges;
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const auto [a, b, c] = triangles[t];
    if (std::set<Index>{a, b, c}.size() < 3) continue;
    for (const Edge& e :
         {Edge(std::minmax(a, b)), Edge(std::minmax(b, c)), Edge(std::minmax(c, a))}) {
      edges[e].push_back(static_cast<Index>(t));
    }
  }
  return edges;
}

TEST(HalfEdges, AgreeWithAMapOfTheEdges) {
  const auto triangles = crowded_triangles(4000, 60);
  const auto expected = triangles_of_edges(triangles);
  const auto half_edges = sorted_half_edges(triangles, 60);
  auto next = expected.begin();
  for_each_edge(half_edges, [&](std::span<const HalfEdge> edge) {
    ASSERT_NE(next, expected.end());
    EXPECT_EQ(Edge(edge[0].lo, edge[0].hi), next->first);
    std::vector<Index> found;
    for (const HalfEdge& h : edge) found.push_back(h.triangle);
    EXPECT_EQ(found, next->second);
    ++next;
  });
  EXPECT_EQ(next, expected.end());
}

TEST(HalfEdges, RunFromTheirCornerToTheNext) {
  const auto triangles = crowded_triangles(500, 20);
  for (const HalfEdge& h : sorted_half_edges(triangles, 20)) {
    const Triangle& t = triangles[h.triangle];
    const Index from = t[static_cast<std::size_t>(h.corner)];
    const Index to = t[static_cast<std::size_t>(h.corner + 1) % 3];
    EXPECT_LT(h.lo, h.hi);
    EXPECT_EQ(from, h.forward ? h.lo : h.hi);
    EXPECT_EQ(to, h.forward ? h.hi : h.lo);
    EXPECT_EQ(t[h.corner_at_lo() % 3], h.lo);
    EXPECT_EQ(t[h.corner_at_hi() % 3], h.hi);
    EXPECT_EQ(h.corner_at_lo() / 3, static_cast<std::size_t>(h.triangle));
    EXPECT_EQ(h.corner_at_hi() / 3, static_cast<std::size_t>(h.triangle));
  }
}

TEST(HalfEdges, OfACubeComeInOppositePairs) {
  const TriMesh surface = cube();
  const auto half_edges = sorted_half_edges(surface.triangles, surface.points.size());
  EXPECT_EQ(half_edges.size(), 36u);
  for_each_edge(half_edges, [](std::span<const HalfEdge> edge) {
    ASSERT_EQ(edge.size(), 2u);
    EXPECT_NE(edge[0].forward, edge[1].forward);
  });
}

/// Two cubes that share a corner, and beside them triangles without area.
TEST(PointsOfSeveralFans, AreWhereASurfaceTouchesItself) {
  TriMesh cubes = joined(cube(), cube({1, 1, 1}));
  const Vec3 shared{1, 1, 1};
  const auto first = std::ranges::find(cubes.points, shared);
  ASSERT_NE(first, cubes.points.end());
  const Index corner = static_cast<Index>(first - cubes.points.begin());
  for (Triangle& t : cubes.triangles) {
    for (Index& p : t) {
      if (cubes.points[p] == shared) p = corner;
    }
  }
  cubes.triangles.push_back({0, 0, 1});
  const auto several = points_of_several_fans(
      cubes.triangles, sorted_half_edges(cubes.triangles, cubes.points.size()),
      cubes.points.size());
  for (Index p = 0; p < std::ssize(several); ++p) EXPECT_EQ(several[p], p == corner ? 1 : 0) << p;
}

TEST(ConnectedTriangles, AgreeWithAWalkAcrossEdges) {
  // 40 triangles over 90 points: some share an edge, most do not.
  auto triangles = crowded_triangles(40, 90);
  for (std::size_t t = 0; t + 1 < 40; t += 3) triangles[t + 1][0] = triangles[t][0];
  for (std::size_t t = 0; t + 1 < 40; t += 3) triangles[t + 1][1] = triangles[t][1];
  const auto edges = triangles_of_edges(triangles);
  std::vector<std::size_t> expected(triangles.size());
  for (std::size_t t = 0; t < expected.size(); ++t) expected[t] = t;
  for (bool changed = true; changed;) {  // each takes the least name of its neighbours
    changed = false;
    for (const auto& [edge, around] : edges) {
      for (const Index s : around) {
        for (const Index t : around) {
          changed |= expected[t] > expected[s];
          expected[t] = std::min(expected[t], expected[s]);
        }
      }
    }
  }
  DisjointSets parts = connected_triangles(sorted_half_edges(triangles, 90), triangles.size());
  std::set<std::size_t> names;
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    EXPECT_EQ(parts.find(t), expected[t]);
    names.insert(expected[t]);
  }
  EXPECT_LT(names.size(), triangles.size());
  EXPECT_GT(names.size(), 5u);
}

}  // namespace
}  // namespace mesamis
