// SPDX-License-Identifier: Apache-2.0
#include "mesamis/remesh/cavity.h"

#include <set>

#include "remesh/small_mesh.h"

namespace mesamis {
namespace {

const FormulaMetric kCoarse = uniform_metric(1);

TEST(Cavity, BallHoldsEveryCellAroundTheVertex) {
  SmallMesh small(perturbed_box(kUnitBox, {3, 3, 3}, 0.2), kCoarse);
  for (Index v = 0; v < std::ssize(small.mesh.vertices); ++v) {
    std::set<Index> expected;
    for (Index c = 0; c < std::ssize(small.mesh.cells); ++c) {
      if (local_index(small.mesh.cells[c].points, v) >= 0) expected.insert(c);
    }
    const auto ball = small.bench.cavity.ball(v);
    EXPECT_EQ(std::set<Index>(ball.begin(), ball.end()), expected);
    EXPECT_EQ(ball.size(), expected.size());
  }
}

void expect_shell(const SmallMesh& small, Index a, Index b) {
  const Cavity& cavity = small.bench.cavity;
  std::set<Index> expected;
  for (Index c = 0; c < std::ssize(small.mesh.cells); ++c) {
    const Cell& points = small.mesh.cells[c].points;
    if (local_index(points, a) >= 0 && local_index(points, b) >= 0) expected.insert(c);
  }
  EXPECT_EQ(std::set<Index>(cavity.shell().begin(), cavity.shell().end()), expected);
  ASSERT_EQ(cavity.shell().size(), expected.size());
  ASSERT_EQ(cavity.ring().size(), expected.size() + (cavity.shell_is_closed() ? 0 : 1));
  for (std::size_t i = 0; i < cavity.shell().size(); ++i) {
    const Index c = cavity.ring()[i], d = cavity.ring()[(i + 1) % cavity.ring().size()];
    EXPECT_GT(quality3(small.mesh, {a, b, c, d}), 0);
    EXPECT_GE(local_index(small.mesh.cells[cavity.shell()[i]].points, c), 0);
    EXPECT_GE(local_index(small.mesh.cells[cavity.shell()[i]].points, d), 0);
  }
}

TEST(Cavity, ShellGoesRoundTheEdgeInOrder) {
  SmallMesh small(perturbed_box(kUnitBox, {2, 3, 2}, 0.2), kCoarse);
  for (Index c = 0; c < std::ssize(small.mesh.cells); ++c) {
    for (const auto& [i, j] : kCellEdges) {
      const Index a = small.mesh.cells[c].points[i], b = small.mesh.cells[c].points[j];
      ASSERT_TRUE(small.bench.cavity.find_shell(c, a, b));
      const bool on_box = small.mesh.vertices[a].mask & small.mesh.vertices[b].mask;
      EXPECT_EQ(small.bench.cavity.shell_is_closed(), !on_box);
      expect_shell(small, a, b);
    }
  }
}

TEST(Cavity, ReplacingCellsByThemselvesKeepsTheMesh) {
  SmallMesh small(perturbed_box(kUnitBox, {3, 2, 2}, 0.2), kCoarse);
  Cavity& cavity = small.bench.cavity;
  for (Index v = 0; v < std::ssize(small.mesh.vertices); ++v) {
    const auto ball = cavity.ball(v);
    cavity.clear();
    // Another order of the cells and an even permutation of their points change nothing.
    for (auto c = ball.rbegin(); c != ball.rend(); ++c) {
      const Cell& k = small.mesh.cells[*c].points;
      cavity.propose({k[1], k[2], k[0], k[3]}, small.mesh.cells[*c].quality3, 1);
    }
    cavity.replace(ball);
    expect_sound(small.mesh);
  }
}

}  // namespace
}  // namespace mesamis
