// SPDX-License-Identifier: Apache-2.0
#include "mesamis/remesh/split.h"

#include "remesh/small_mesh.h"

namespace mesamis {
namespace {

TEST(Split, EveryEdgeOfABoxMeshCanBeSplit) {
  const FormulaMetric metric = uniform_metric(1);
  SmallMesh small(box_mesh(kUnitBox, {2, 2, 2}), metric);
  const auto cells = static_cast<Index>(small.mesh.cells.size());
  for (Index c = 0; c < cells; ++c) {
    const Index a = small.mesh.cells[c].points[0], b = small.mesh.cells[c].points[3];
    const std::int64_t before = small.mesh.vertex_count();
    ASSERT_TRUE(split_edge(small.bench, {c, a, b, true}, {}));
    EXPECT_EQ(small.mesh.vertex_count(), before + 1);
    expect_sound(small.mesh);
  }
}

TEST(Split, PassLeavesNoLongEdgeWhereItMay) {
  const FormulaMetric metric = uniform_metric(0.2);
  SmallMesh small(box_mesh(kUnitBox, {1, 1, 1}), metric);
  std::int64_t splits = 0, last = 0;
  do {
    last = split_long_edges(small.bench, {});
    splits += last;
  } while (last > 0);
  EXPECT_GT(splits, 100);
  expect_sound(small.mesh);
  for (const WorkCell& cell : small.mesh.cells) {
    for (const auto& [i, j] : kCellEdges) {
      // Longer edges are urgent, and on a uniform metric every split is valid.
      EXPECT_LE(length(small.mesh.vertices[cell.points[i]], small.mesh.vertices[cell.points[j]]),
                2);
    }
  }
}

TEST(Split, MiddleHalvesTheLengthWhereSizesGrowGeometrically) {
  // Sizes exp(2 x): the edge from 0 to 1 has length (1 - exp(-2)) / 2, half of it ends where
  // exp(-2 x) = (1 + exp(-2)) / 2.
  const FormulaMetric metric([](const Vec3& p) { return std::exp(-4 * p.x) * kIdentity3; });
  SmallMesh small(box_mesh(kUnitBox, {1, 1, 1}), metric);
  const Index c = cell_with(small.mesh, 0, 1);
  ASSERT_TRUE(split_edge(small.bench, {c, 0, 1, true}, {}));
  const Vec3 middle = small.mesh.vertices.back().position;
  EXPECT_NEAR(middle.x, -std::log((1 + std::exp(-2.0)) / 2) / 2, 1e-6);
  EXPECT_EQ(middle.y, 0);
  EXPECT_EQ(middle.z, 0);
}

TEST(Split, RefusesCrowdingAndKeepsTheMesh) {
  const FormulaMetric metric = uniform_metric(2);  // every edge is short
  SmallMesh small(box_mesh(kUnitBox, {2, 2, 2}), metric);
  const auto cells = small.mesh.cell_count();
  EXPECT_FALSE(split_edge(small.bench, {0, 0, small.mesh.cells[0].points[1]}, {}));
  EXPECT_EQ(small.mesh.cell_count(), cells);
  expect_sound(small.mesh);
}

TEST(Split, BalancedDistanceIsNoMoreThanTheGoal) {
  // A balanced rule asks for no more than the goal's lower bound, whatever new_length_min says.
  const FormulaMetric metric = uniform_metric(1 / 1.5);
  for (const double balance : {0.95, 2.0}) {
    SmallMesh small(box_mesh(kUnitBox, {1, 1, 1}), metric);
    const auto splits = split_long_edges(
        small.bench, {.new_length_min = 100, .balance = balance, .urgent_length = 10});
    EXPECT_GT(splits, 0);
  }
  SmallMesh small(box_mesh(kUnitBox, {1, 1, 1}), metric);
  EXPECT_EQ(split_long_edges(small.bench, {.new_length_min = 100, .urgent_length = 10}), 0);
  expect_sound(small.mesh);
}

TEST(Split, StopsAtTheMostCells) {
  const FormulaMetric metric = uniform_metric(0.01);
  SmallMesh small(box_mesh(kUnitBox, {2, 2, 2}), metric);
  for (int pass = 0; pass < 20; ++pass) split_long_edges(small.bench, {.most_cells = 500});
  EXPECT_GE(small.mesh.cell_count(), 500);
  EXPECT_LE(small.mesh.cell_count(), 500 + static_cast<std::int64_t>(Cavity::kMostShell));
}

}  // namespace
}  // namespace mesamis
