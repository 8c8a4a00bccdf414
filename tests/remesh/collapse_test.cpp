// SPDX-License-Identifier: Apache-2.0
#include "mesamis/remesh/collapse.h"

#include "remesh/small_mesh.h"

namespace mesamis {
namespace {

TEST(Collapse, ABoxMeshFallsToItsCorners) {
  const FormulaMetric metric = uniform_metric(100);
  SmallMesh small(perturbed_box(kUnitBox, {3, 3, 3}, 0.2), metric);
  std::int64_t last = 0;
  do {
    last = collapse_short_edges(small.bench, {});
    expect_sound(small.mesh);
    set_pending(small.mesh, kToAll);
  } while (last > 0);
  EXPECT_LT(small.mesh.vertex_count(), 20);
  int corners = 0;
  for (const Vertex& v : small.mesh.vertices) {
    corners += v.cell != kNoIndex && std::popcount(unsigned{v.mask}) == 3;
  }
  EXPECT_EQ(corners, 8);
}

TEST(Collapse, VerticesDoNotLeaveTheirPlanes) {
  const FormulaMetric metric = uniform_metric(100);
  SmallMesh small(perturbed_box(kUnitBox, {3, 3, 3}, 0.2), metric);
  for (Index c = 0; c < std::ssize(small.mesh.cells); ++c) {
    for (const auto& [i, j] : kCellEdges) {
      const Cell points = small.mesh.cells[c].points;
      if (points[0] == kNoIndex) break;
      const auto from = small.mesh.vertices[points[i]].mask,
                 to = small.mesh.vertices[points[j]].mask;
      const bool done = collapse_vertex(small.bench, points[i], points[j], {});
      if (from & ~to) {
        EXPECT_FALSE(done);
      }
      if (done) break;
    }
  }
  expect_sound(small.mesh);
}

TEST(Collapse, KeepsNewEdgesShort) {
  const FormulaMetric metric = uniform_metric(0.5);
  SmallMesh small(perturbed_box(kUnitBox, {6, 6, 6}, 0.2), metric);
  EXPECT_GT(collapse_short_edges(small.bench, {}), 0);
  for (const WorkCell& cell : small.mesh.cells) {
    if (!cell.alive()) continue;
    for (const auto& [i, j] : kCellEdges) {
      EXPECT_LE(length(small.mesh.vertices[cell.points[i]], small.mesh.vertices[cell.points[j]]),
                1.6);
    }
  }
  expect_sound(small.mesh);
}

TEST(Collapse, ShorterEdgesMayMakeLongerOnes) {
  // 4 x 4 x 4 bricks with edges of 0.66: what goes leaves edges of up to 1.6.
  const FormulaMetric metric = uniform_metric(0.375);
  SmallMesh strict(box_mesh(kUnitBox, {4, 4, 4}), metric);
  EXPECT_EQ(collapse_short_edges(strict.bench, {.new_length_max = 1}), 0);
  SmallMesh narrow(box_mesh(kUnitBox, {4, 4, 4}), metric);
  EXPECT_GT(collapse_short_edges(narrow.bench, {.new_length_max = 1, .balance = 1.2}), 0);
  expect_sound(narrow.mesh);
}

}  // namespace
}  // namespace mesamis
