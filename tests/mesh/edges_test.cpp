// SPDX-License-Identifier: Apache-2.0
#include "mesamis/mesh/edges.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

#include "support/perturbed_box.h"

namespace mesamis {
namespace {

/// All pairs of points of each cell, in a set.
std::set<Edge> edges_by_brute_force(const TetMesh& mesh) {
  std::set<Edge> edges;
  for (const Cell& cell : mesh.cells) {
    for (const Index a : cell) {
      for (const Index b : cell) {
        if (a < b) edges.insert({a, b});
      }
    }
  }
  return edges;
}

void expect_all_edges(const TetMesh& mesh) {
  const std::vector<Edge> edges = unique_edges(mesh);
  const std::set<Edge> expected = edges_by_brute_force(mesh);
  EXPECT_TRUE(std::equal(edges.begin(), edges.end(), expected.begin(), expected.end()));
}

TEST(UniqueEdges, AgreeWithASetOfPairs) {
  expect_all_edges(box_mesh({{0, 0, 0}, {1, 1, 1}}, {5, 4, 3}));
  // Connectivity alone counts: cells at random, with numbers in no order.
  TetMesh mesh{std::vector<Vec3>(60), {}};
  std::mt19937 generator(1);
  std::vector<Index> points(60);
  for (std::size_t i = 0; i < points.size(); ++i) points[i] = static_cast<Index>(i);
  for (int c = 0; c < 500; ++c) {
    std::shuffle(points.begin(), points.end(), generator);
    mesh.cells.push_back({points[0], points[1], points[2], points[3]});
  }
  expect_all_edges(mesh);
}

TEST(UniqueEdges, OfAKuhnBoxSatisfyEulersFormula) {
  const TetMesh mesh = box_mesh({{0, 0, 0}, {1, 1, 1}}, {7, 5, 6});
  // points - edges + faces - cells = 1, and 4 cells = 2 faces - outer faces.
  const std::int64_t cells = std::ssize(mesh.cells), outer = 2 * 2 * (7 * 5 + 5 * 6 + 6 * 7);
  const std::int64_t faces = (4 * cells + outer) / 2;
  EXPECT_EQ(std::ssize(unique_edges(mesh)), std::ssize(mesh.points) + faces - cells - 1);
}

TEST(UniqueEdges, OfNoCellsAreNone) {
  EXPECT_TRUE(unique_edges({}).empty());
  EXPECT_TRUE(unique_edges({{{0, 0, 0}, {1, 0, 0}}, {}}).empty());
}

}  // namespace
}  // namespace mesamis
