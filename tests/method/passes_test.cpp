// SPDX-License-Identifier: Apache-2.0
#include "mesamis/method/passes.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "mesamis/fem/mesh_space.h"
#include "mesamis/mesh/metric_field.h"
#include "mesamis/method/prepare.h"
#include "mesamis/method/setting_table.h"
#include "mesamis/remesh/remesh.h"
#include "support/ball_volume.h"
#include "support/oracle.h"

namespace mesamis {
namespace {

/// The preset as it stands, on a grid of 1 mm.
Prepared prepared_by_the_paper() {
  Settings settings = preset_settings("paper");
  settings.window = Window{0, 255};
  settings.threshold_rule = ThresholdRule::kNone;
  return prepare_image(make_ball({.size = 16, .radius = 5}), settings);
}

/// The preset's own pass through Algorithm 1, estimator, metric and (12), against an independent
/// implementation on a mesh of its own.
TEST(PaperPreset, OnePassAgreesWithTheOracle) {
  MESAMIS_REQUIRE_DATA(oracle_path());
  const auto oracle = read_oracle();
  const auto expected = oracle["cases"]["paper_parameters"];
  const TetMesh mesh = oracle_mesh(oracle);
  const MeshSpace space(mesh);
  const Prepared prepared = prepared_by_the_paper();
  const RunInput run(prepared);

  Minimum minimum;
  minimum.f = oracle["f"].get<std::vector<double>>();
  AmisOptions options = run.draft_options();
  EXPECT_EQ(options.solver.tolerance, run.final_options().solver.tolerance) << "no drafts";
  options.max_iterations = static_cast<int>(expected["steps"].size());
  options.v_tolerance = 0;
  options.solver.tolerance = 1e-12;
  Iteration record;
  minimise_on(space, options, minimum, record);
  minimum.lumped_mass = space.lumped_mass();
  EXPECT_NEAR(record.energy.total() / expected["steps"].back()["energy_after_v"].get<double>(), 1,
              1e-9);
  EXPECT_LT(relative_difference(minimum.u, expected["steps"].back()["u"]), 1e-8);
  EXPECT_LT(relative_difference(minimum.v, expected["steps"].back()["v"]), 1e-8);

  const double goal = expected["scaled"]["NMAX"];
  const SizeControl free{1e-9, 1e9, 0};
  const Progress no_progress;
  const Stage stage(no_progress, "test");
  const std::vector<Sym3> metric = mesh_metric({run, 2, stage, record}, mesh, minimum, free);
  EXPECT_NEAR(record.estimator / expected["estimator_sum"].get<double>(), 1, 1e-6);
  EXPECT_NEAR(record.predicted_tets / expected["predicted_cells"].get<double>(), 1, 1e-5);
  // (12), as the oracle scales: by the prediction (11).
  std::vector<double> scaled, found;
  for (const auto& node : expected["scaled"]["node_metric_xx_xy_yy_xz_yz_zz"]) {
    for (const double entry : node) scaled.push_back(entry);
  }
  const double scale = std::pow(goal / record.predicted_tets, 2.0 / 3);
  for (const Sym3& m : metric) {
    for (const double entry : {m.xx, m.xy, m.yy, m.xz, m.yz, m.zz}) found.push_back(scale * entry);
  }
  EXPECT_LT(relative_difference(found, scaled), 1e-5);
}

/// Of a small ball, for ten adaptations without drafts.
Prepared ball_in_voxels_of(double voxel) {
  Prepared prepared;
  prepared.parameters.unit_mm = 1;
  prepared.parameters.adaptations = 10;
  prepared.grey = make_ball({.size = 8, .spacing = {voxel, voxel, voxel}, .radius = 2 * voxel});
  return prepared;
}

TEST(RunInput, DraftsHaveFewerCellsAndTheLastHaveAll) {
  Prepared prepared = ball_in_voxels_of(1);
  Parameters& p = prepared.parameters;
  p.max_tets = 1'000'000;
  p.drafts = true;
  p.solver_tolerance = 1e-6;
  const RunInput run(prepared);
  std::int64_t last = 0;
  for (int k = 1; k <= 10; ++k) {
    EXPECT_GE(run.cells_after(k), last);
    last = run.cells_after(k);
  }
  EXPECT_LT(run.cells_after(1), p.max_tets);
  EXPECT_EQ(last, p.max_tets);
  EXPECT_EQ(run.cells_after(2), p.max_tets) << "one draft of many cells is enough";
  EXPECT_GT(run.draft_options().solver.tolerance, run.final_options().solver.tolerance);
  p.max_tets = 100'000;
  EXPECT_LT(run.cells_after(1), run.cells_after(2));
  EXPECT_LT(run.cells_after(2), run.cells_after(3));
  p.adaptations = 1;
  EXPECT_EQ(run.cells_after(1), p.max_tets) << "the only mesh is the one delivered";
  p.adaptations = 10;
  p.drafts = false;
  EXPECT_EQ(run.cells_after(1), p.max_tets);
  EXPECT_EQ(run.draft_options().solver.tolerance, run.final_options().solver.tolerance);
}

Iteration pass_with(double mesh_change, double energy_change, bool bounded = false) {
  Iteration pass;
  pass.mesh_change = mesh_change;
  pass.energy_change = energy_change;
  pass.bounded = bounded;
  return pass;
}

TEST(HasSettled, WantsBothByEnergyAndOneAsPrinted) {
  Prepared prepared = ball_in_voxels_of(1);
  Parameters& p = prepared.parameters;
  p.until = StopRule::kEnergy;
  p.tol_mesh = p.tol_energy = 0.01;
  const RunInput run(prepared);
  const auto settled = [&run](const Iteration& last) {
    return has_settled(run, {pass_with(1, 1), pass_with(1, 1), last});
  };
  EXPECT_TRUE(settled(pass_with(0.005, 0.005)));
  EXPECT_FALSE(settled(pass_with(0.005, 0.02)));
  EXPECT_FALSE(settled(pass_with(0.03, 0.005)));
  EXPECT_TRUE(settled(pass_with(0.03, 0.005, true))) << "a count that max_tets holds may waver";
  EXPECT_FALSE(settled(pass_with(0.2, 0.005, true)));
  p.until = StopRule::kEither;
  EXPECT_TRUE(settled(pass_with(0.005, 0.02)));
  EXPECT_TRUE(settled(pass_with(0.03, 0.005)));
  EXPECT_FALSE(settled(pass_with(0.03, 0.02)));
  // The first energy change compares the grid with a mesh.
  EXPECT_FALSE(has_settled(run, {pass_with(1, 1), pass_with(0.5, 0.001)}));
}

TEST(HasSettled, WantsTheSurfaceToMoveByNoMoreThanItsError) {
  Prepared prepared = ball_in_voxels_of(2);
  Parameters& p = prepared.parameters;
  const RunInput run(prepared);
  const auto settled = [&run](double change, double tolerance) {
    Iteration last = pass_with(1, 1);
    last.surface_change = change;
    last.surface_tolerance = tolerance;
    return has_settled(run, {pass_with(1, 1), pass_with(1, 1), last});
  };
  EXPECT_TRUE(settled(0.5, 0.6));
  EXPECT_FALSE(settled(0.5, 0.4));
  p.drafts = true;
  p.max_tets = 1'000'000;
  EXPECT_TRUE(has_settled(run, {pass_with(1, 1), pass_with(0, 0)})) << "the second has all of many";
  EXPECT_FALSE(has_settled(run, {pass_with(0, 0)})) << "the first has not";
  Iteration from_grid = pass_with(0, 0);
  from_grid.surface_tolerance = 0.5;
  from_grid.surface_change = 0.55;
  EXPECT_TRUE(has_settled(run, {pass_with(1, 1), from_grid})) << "the grid's is no mesh's surface";
  from_grid.surface_change = 0.65;
  EXPECT_FALSE(has_settled(run, {pass_with(1, 1), from_grid}));
  p.max_tets = 100'000;
  EXPECT_TRUE(settled(0.5, 0.6)) << "the third mesh has all cells";
  EXPECT_FALSE(has_settled(run, {pass_with(1, 1), pass_with(0, 0)})) << "the second has not";
  p.adaptations = 2;
  EXPECT_TRUE(has_settled(run, {pass_with(1, 1), pass_with(0, 0)})) << "no more are allowed";
  p.adaptations = 10;
  EXPECT_FALSE(has_settled(run, {pass_with(0, 0), pass_with(0, 0)})) << "three meshes at least";
  p.surface = SurfaceKind::kBand;
  EXPECT_FALSE(settled(0, 1)) << "a band goes by mesh and energy";
}

TEST(Stage, StopsWhereProgressSaysSo) {
  std::vector<double> shares;
  const Progress progress = [&shares](std::string_view name, double share) {
    EXPECT_EQ(name, "work");
    shares.push_back(share);
    return share < 0.5;
  };
  const Stage stage(progress, "work");
  stage.advance(0.25);
  EXPECT_THROW(stage.advance(0.75), Cancelled);
  EXPECT_EQ(shares, (std::vector<double>{0, 0.25, 0.75}));
}

TEST(AskedMetric, IsTheMetricBeforeItsSizesAreBounded) {
  const Prepared prepared = prepared_by_the_paper();
  const RunInput run(prepared);
  const TetMesh mesh = box_mesh(run.box, {6, 6, 6});
  const Progress silent;
  const Stage stage(silent, "test");
  Iteration record, other;
  const Minimum minimum = minimise({run, 2, stage, record}, mesh, {}, run.draft_options());
  const std::int64_t cells = std::ssize(mesh.cells);
  const std::vector<Sym3> asked = asked_metric({run, 2, stage, record}, mesh, minimum, cells);
  const std::vector<Sym3> metric =
      mesh_metric({run, 2, stage, other}, mesh, minimum, {1e-9, 1e9, 0});
  ASSERT_EQ(asked.size(), mesh.points.size());
  for (std::size_t n = 0; n < asked.size(); ++n) {
    EXPECT_NEAR(asked[n].xx / metric[n].xx, 1, 1e-6);
    EXPECT_GT(determinant(asked[n]), 0);
  }
  EXPECT_EQ(record.estimator, other.estimator);
  EXPECT_EQ(record.predicted_tets, other.predicted_tets);
  EXPECT_GT(record.predicted_tets, 0);
  // The error asked for is that of all cells: as one part of many, this one may have less of it.
  const std::vector<Sym3> part = asked_metric({run, 2, stage, record}, mesh, minimum, 8 * cells);
  for (std::size_t n = 0; n < asked.size(); ++n) {
    EXPECT_GE(determinant(part[n]), 0.999 * determinant(asked[n]));
  }
}

TEST(GridLogMetric, LeadsToTheFirstMesh) {
  Settings settings;
  settings.max_tets = 3000;
  const Prepared prepared = prepare_image(make_ball({.size = 18, .radius = 5}), settings);
  const RunInput run(prepared);
  const Parameters& p = run.parameters;
  const Progress silent;
  const Stage stage(silent, "test");
  Iteration record;
  const GridPass found = minimise_on_grid({run, 1, stage, record});
  const auto logs_for = [&](double complexity) {
    return grid_log_metric({run, 1, stage, record}, found.grid,
                           {found.minimum.u, found.minimum.v, found.image(run)},
                           {p.h_min, p.h_max, complexity});
  };
  const double cells = 1000;
  const auto logs = logs_for(cells / kCellsPerComplexity);
  ASSERT_EQ(logs.size(), found.grid.node_count());
  EXPECT_TRUE(record.bounded);
  EXPECT_GT(record.estimator, 0);
  const GridMetricField field(run.box, found.grid.size, logs);
  EXPECT_NEAR(cells_for_metric(field, run.box) / cells, 1, 0.1);
  logs_for(1e12);
  EXPECT_FALSE(record.bounded);
}

}  // namespace
}  // namespace mesamis
