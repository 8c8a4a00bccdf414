// SPDX-License-Identifier: Apache-2.0
#include "mesamis/remesh/remesher.h"

#include <gtest/gtest.h>

#include "mesamis/base/error.h"
#include "mesamis/mesh/metric.h"
#include "remesh/small_mesh.h"
#include "support/throws.h"

namespace mesamis {
namespace {

using testing::HasSubstr;

/// A remesher of a perturbed box with what it refers to.
struct Bench {
  explicit Bench(double size, const RemeshOptions& with = {}, const Index bricks = 5)
      : metric(uniform_metric(size)),
        options(with),
        small(perturbed_box(kUnitBox, {bricks, bricks, bricks}, 0.2), metric),
        remesher(small.mesh, small.sampler, options) {}
  FormulaMetric metric;
  RemeshOptions options;
  SmallMesh small;
  Remesher remesher;
};

TEST(Remesher, AdaptsAndStaysSound) {
  Bench bench(0.12);
  bench.remesher.adapt();
  EXPECT_TRUE(bench.remesher.report().converged);
  EXPECT_GT(bench.remesher.report().rounds, 0);
  const WorkingMesh& mesh = bench.remesher.result();
  expect_sound(mesh);
  EXPECT_TRUE(mesh.free_cells.empty() && mesh.free_vertices.empty());
  const TetMesh result = unload(mesh);
  EXPECT_GT(measure_fit(result, metrics_at_nodes(result, bench.metric)).unit_edge_fraction, 0.95);
}

TEST(Remesher, PolishingMakesCellsBetterAndNoVertices) {
  Bench bench(0.15);
  bench.remesher.adapt();
  const WorkingMesh before = bench.remesher.result();
  bench.remesher.polish();
  const WorkingMesh& after = bench.remesher.result();
  expect_sound(after);
  EXPECT_LE(after.vertex_count(), before.vertex_count());
  EXPECT_GE(worst_quality3(after), worst_quality3(before));
}

TEST(Remesher, RepairKeepsTheBox) {
  Bench bench(0.15);
  bench.remesher.adapt();
  bench.remesher.repair();
  expect_sound(bench.remesher.result());
}

TEST(Remesher, RoundsEndAtTheirMost) {
  RemeshOptions options;
  options.max_rounds = 2;
  Bench bench(0.05, options);
  bench.remesher.adapt();
  EXPECT_EQ(bench.remesher.report().rounds, 2);
  EXPECT_FALSE(bench.remesher.report().converged);
  expect_sound(bench.remesher.result());
}

TEST(Remesher, HoldsTheCountAtItsMost) {
  RemeshOptions options;
  options.max_cells = 2000;
  Bench bench(0.05, options);
  bench.remesher.adapt();
  EXPECT_GT(bench.remesher.report().size_factor, 1.5);
  EXPECT_LT(bench.remesher.result().cell_count(), 2200);
  EXPECT_GT(bench.remesher.result().cell_count(), 1500);
}

/// Work on parts sees each cell once, and what it counts is summed up.
TEST(Remesher, PartsHoldAllCellsTogether) {
  RemeshOptions options;
  options.part_cells = 1000;
  Bench bench(0.1, options, 12);
  const auto cells = bench.remesher.result().cell_count();
  ASSERT_GT(cells, 4000);
  const Counters seen = bench.remesher.on_parts(
      0, [](Workbench& part) { return Counters{.splits = 1, .moves = part.mesh.cell_count()}; });
  EXPECT_GE(seen.splits, 4);
  EXPECT_EQ(seen.moves, cells);
  EXPECT_EQ(bench.remesher.report().part_seconds.size(), 1u);
  expect_sound(bench.remesher.result());
}

TEST(Remesher, ASmallMeshIsOnePart) {
  Bench bench(0.2);
  const Counters seen =
      bench.remesher.on_parts(0, [](Workbench&) { return Counters{.splits = 1}; });
  EXPECT_EQ(seen.splits, 1);
  EXPECT_TRUE(bench.remesher.report().part_seconds.empty());
}

TEST(Remesher, RefusesMoreCellsThanFit) {
  EXPECT_REFUSED(Bench(1e-4), HasSubstr("or a limit of cells"));
}

TEST(Remesher, ProgressStopsIt) {
  RemeshOptions options;
  options.progress = [](std::string_view, double) { return false; };
  Bench bench(0.2, options);
  EXPECT_THROW(bench.remesher.adapt(), Cancelled);
}

}  // namespace
}  // namespace mesamis
