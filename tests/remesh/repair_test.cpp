// SPDX-License-Identifier: Apache-2.0
#include "mesamis/remesh/repair.h"

#include "remesh/small_mesh.h"

namespace mesamis {
namespace {

/// A box mesh with one inner vertex moved next to a face of one of its cells.
TetMesh with_a_sliver() {
  TetMesh mesh = box_mesh(kUnitBox, {3, 3, 3});
  const Cell cell = [&mesh] {
    for (const Cell& c : mesh.cells) {
      if (planes_of(kUnitBox, mesh.points[c[0]]) == 0) return c;
    }
    return Cell{};
  }();
  const Vec3 face =
      (1.0 / 3) * (mesh.points[cell[1]] + mesh.points[cell[2]] + mesh.points[cell[3]]);
  mesh.points[cell[0]] = face + 0.02 * (mesh.points[cell[0]] - face);
  return mesh;
}

TEST(Repair, MakesTheWorstCellBetterAndKeepsTheMesh) {
  const FormulaMetric metric = uniform_metric(0.35);
  SmallMesh small(with_a_sliver(), metric);
  const double before = worst_quality3(small.mesh);
  ASSERT_LT(before, 0.01);
  ASSERT_EQ(find_flaw(unload(small.mesh), kUnitBox), "");
  const Counters done = repair_worst_cells(small.bench, {});
  EXPECT_GT(done.collapses + done.swaps + done.moves, 0);
  EXPECT_GT(worst_quality3(small.mesh), 5 * before);
  expect_sound(small.mesh);
}

/// None of its steps makes the worst cell around it worse.
TEST(Repair, NeverMakesTheWorstCellWorse) {
  const FormulaMetric metric([](const Vec3& p) {
    const double h = 0.05 + 0.3 * p.x;
    return Sym3{1 / (h * h), 0, 0, 1 / (h * h), 0, 9 / (h * h)};
  });
  for (unsigned seed = 1; seed <= 4; ++seed) {
    SmallMesh small(perturbed_box(kUnitBox, {5, 5, 5}, 0.2, seed), metric);
    const double before = worst_quality3(small.mesh);
    repair_worst_cells(small.bench, {.quality3_max = 0.5});
    EXPECT_GE(worst_quality3(small.mesh), before);
    expect_sound(small.mesh);
  }
}

TEST(Repair, LeavesGoodCellsAlone) {
  const FormulaMetric metric = uniform_metric(0.5);
  SmallMesh small(box_mesh(kUnitBox, {2, 2, 2}), metric);
  const TetMesh before = unload(small.mesh);
  const Counters done = repair_worst_cells(small.bench, {.quality3_max = 0.01});
  EXPECT_EQ(done.collapses + done.swaps + done.moves, 0);
  EXPECT_EQ(unload(small.mesh).points, before.points);
  EXPECT_EQ(unload(small.mesh).cells, before.cells);
}

}  // namespace
}  // namespace mesamis
