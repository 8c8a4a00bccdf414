// SPDX-License-Identifier: Apache-2.0
#include "mesamis/remesh/shape_repair.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "mesamis/mesh/element_quality.h"
#include "remesh/small_body.h"

namespace mesamis {
namespace {

const FormulaMetric kMetric = uniform_metric(0.25);

/// As the repair weighs shapes inside: 1 where the rule is just kept.
double worst_shape(const WorkingMesh& mesh, const ShapeRule& rule) {
  double worst = 1;
  for (const WorkCell& cell : mesh.cells) {
    if (!cell.alive() || cell.material == kOutside) continue;
    std::array<Vec3, 4> corners;
    for (std::size_t i = 0; i < 4; ++i) corners[i] = mesh.vertices[cell.points[i]].position;
    const ElementShape shape = element_shape(corners);
    worst = std::min({worst, shape.least_angle / rule.least_angle,
                      (180 - shape.greatest_angle) / (180 - rule.greatest_angle),
                      shape.scaled_jacobian / rule.scaled_jacobian});
  }
  return worst;
}

TEST(ShapeRepair, MakesTheWorstShapeOfABoxBetter) {
  for (const unsigned seed : {1u, 2u, 3u}) {
    SmallMesh small(perturbed_box(kUnitBox, {4, 4, 4}, 0.3, seed), kMetric);
    const double before = worst_shape(small.mesh, {});
    ASSERT_LT(before, 0.7);
    const Counters done = repair_shapes(small.bench, {});
    EXPECT_GT(worst_shape(small.mesh, {}), before);
    EXPECT_GT(done.swaps + done.moves + done.collapses, 0);
    EXPECT_EQ(done.splits, 0);
    expect_sound(small.mesh);  // it fills its box still
  }
}

TEST(ShapeRepair, NeverMakesTheWorstShapeWorse) {
  SmallMesh small(perturbed_box(kUnitBox, {4, 4, 4}, 0.3), kMetric);
  double last = worst_shape(small.mesh, {});
  for (int i = 0; i < 4; ++i) {
    set_pending(small.mesh, kToRepair);
    repair_shapes(small.bench, {.sweeps = 1});
    const double now = worst_shape(small.mesh, {});
    EXPECT_GE(now, last);
    last = now;
  }
}

TEST(ShapeRepair, LeavesGoodCellsAlone) {
  SmallMesh small(box_mesh(kUnitBox, {4, 4, 4}), kMetric);
  ASSERT_EQ(worst_shape(small.mesh, {}), 1);
  const auto before = mesh_hash(unload(small.mesh));
  const Counters done = repair_shapes(small.bench, {});
  EXPECT_EQ(done.swaps + done.moves + done.collapses, 0);
  EXPECT_EQ(mesh_hash(unload(small.mesh)), before);
}

TEST(ShapeRepair, FrozenVerticesStay) {
  SmallMesh small(perturbed_box(kUnitBox, {4, 4, 4}, 0.3), kMetric);
  small.mesh.is_part = true;
  for (Vertex& vertex : small.mesh.vertices) vertex.mask |= kFrozen;
  repair_shapes(small.bench, {});
  EXPECT_EQ(small.mesh.vertex_count(), 125);
  for (std::size_t v = 0; v < small.mesh.vertices.size(); ++v) {
    EXPECT_NE(small.mesh.vertices[v].cell, kNoIndex);
  }
  EXPECT_EQ(unload(small.mesh).points, perturbed_box(kUnitBox, {4, 4, 4}, 0.3).points);
}

/// The lower half of a box whose inner vertices are shaken: its skin stays flat, so its volume is
/// kept.
TEST(ShapeRepair, KeepsAFlatSkinAndTheVolume) {
  const PlaneShape half({0, 0, 1}, 0.5, 1, kOutside);
  TetMesh shaken = perturbed_box(kUnitBox, {4, 4, 4}, 0.3);
  const TetMesh still = box_mesh(kUnitBox, {4, 4, 4});
  for (std::size_t i = 0; i < still.points.size(); ++i) {
    if (still.points[i].z == 0.5) shaken.points[i].z = 0.5;
  }
  SmallBody body(shaken, kMetric, half);
  const double before = worst_shape(body.mesh, {});
  ASSERT_LT(before, 0.9);
  ASSERT_NEAR(volume_of(body.mesh), 0.5, 1e-12);
  repair_shapes(body.bench, {});
  EXPECT_GT(worst_shape(body.mesh, {}), before);
  expect_sound_body(body.mesh);
  // Within the tolerance over the area of the skin.
  EXPECT_NEAR(volume_of(body.mesh), 0.5, FormulaShape::kTolerance);
  for (const Vertex& vertex : body.mesh.vertices) {
    if (vertex.cell == kNoIndex || !(vertex.mask & kOnSkin)) continue;
    EXPECT_LE(std::abs(half.distance(vertex.position)), FormulaShape::kTolerance);
  }
}

}  // namespace
}  // namespace mesamis
