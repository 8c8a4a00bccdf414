// SPDX-License-Identifier: Apache-2.0
#include "mesamis/remesh/smooth.h"

#include "mesamis/remesh/split.h"
#include "remesh/small_mesh.h"

namespace mesamis {
namespace {

TEST(Smooth, EveryMoveLowersTheEnergy) {
  const FormulaMetric metric = ugawg_metric(Ugawg::kPolar1, 0.5);
  SmallMesh small(perturbed_box(kUnitBox, {5, 5, 5}, 0.2), metric);
  std::int64_t moves = 0;
  for (Index v = 0; v < std::ssize(small.mesh.vertices); ++v) {
    const double before = total_energy(small.mesh);
    const bool moved = smooth_vertex(small.bench, v, {});
    if (moved) {
      EXPECT_LT(total_energy(small.mesh), before);
    }
    moves += moved;
  }
  EXPECT_GT(moves, 20);
  expect_sound(small.mesh);
}

TEST(Smooth, BoundaryVerticesStayOnTheirPlanes) {
  const FormulaMetric metric = ugawg_metric(Ugawg::kPolar1, 0.5);
  SmallMesh small(perturbed_box(kUnitBox, {5, 5, 5}, 0.2), metric);
  const auto before = small.mesh.vertices;
  for (int pass = 0; pass < 5; ++pass) smooth_bad_cells(small.bench, {.quality3_max = 1});
  int on_box_moved = 0;
  for (std::size_t v = 0; v < before.size(); ++v) {
    const Vertex& now = small.mesh.vertices[v];
    EXPECT_EQ(now.mask, before[v].mask);
    if (std::popcount(unsigned{now.mask}) == 3) {
      EXPECT_EQ(now.position, before[v].position);
    }
    on_box_moved += now.mask != 0 && now.position != before[v].position;
  }
  EXPECT_GT(on_box_moved, 0);
  expect_sound(small.mesh);
}

TEST(Smooth, UndoesAPerturbation) {
  const FormulaMetric metric = uniform_metric(0.25);
  SmallMesh small(perturbed_box(kUnitBox, {4, 4, 4}, 0.2), metric);
  const SmallMesh regular(box_mesh(kUnitBox, {4, 4, 4}), metric);
  for (int pass = 0; pass < 30; ++pass) {
    set_pending(small.mesh, kToSmooth);
    if (smooth_bad_cells(small.bench, {.quality3_max = 1}) == 0) break;
  }
  EXPECT_LT(total_energy(small.mesh), 1.02 * total_energy(regular.mesh));
}

/// A vertex inside that finds no better place.
Index settled_vertex(SmallMesh& small) {
  for (int pass = 0; pass < 50; ++pass) {
    for (Index v = 0; v < std::ssize(small.mesh.vertices); ++v) {
      const Vertex& vertex = small.mesh.vertices[v];
      if (vertex.mask == 0 && !smooth_vertex(small.bench, v, {}) && vertex.failures == 1) return v;
    }
  }
  return kNoIndex;
}

TEST(Smooth, WhatFailedRestsUntilACellAroundIsMade) {
  const FormulaMetric metric = uniform_metric(0.25);
  SmallMesh small(perturbed_box(kUnitBox, {4, 4, 4}, 0.05), metric);
  const Index v = settled_vertex(small);
  ASSERT_NE(v, kNoIndex);
  Vertex& vertex = small.mesh.vertices[v];
  ASSERT_EQ(vertex.rest, 1);
  vertex.position += Vec3{0.02, 0.03, -0.01};  // a place that it would leave
  for (const Index c : small.bench.cavity.ball(v)) {
    WorkCell& cell = small.mesh.cells[c];
    cell.quality3 = static_cast<float>(quality3(small.mesh, cell.points));
  }
  EXPECT_FALSE(smooth_vertex(small.bench, v, {}));  // rests
  EXPECT_TRUE(smooth_vertex(small.bench, v, {}));
  vertex.failures = vertex.rest = 2;
  const Cell points = small.mesh.cells[vertex.cell].points;
  ASSERT_TRUE(split_edge(small.bench, {vertex.cell, points[0], points[1], true}, {}));
  EXPECT_EQ(small.mesh.vertices[v].rest, 0);
  expect_sound(small.mesh);
}

TEST(Smooth, ASmallGainDoesNotMakeNeighboursMove) {
  const FormulaMetric metric = ugawg_metric(Ugawg::kPolar1, 0.5);
  for (const double small_gain : {0.0, 1.0}) {
    SmallMesh small(perturbed_box(kUnitBox, {5, 5, 5}, 0.2), metric);
    for (WorkCell& cell : small.mesh.cells) cell.pending = 0;
    ASSERT_GT(smooth_vertex(small.bench, 100, {.small_gain = small_gain}), 0);
    for (const Index c : small.bench.cavity.ball(100)) {
      EXPECT_EQ(small.mesh.cells[c].pending, small_gain > 0 ? kToAll & ~kToSmooth : kToAll);
    }
  }
}

}  // namespace
}  // namespace mesamis
