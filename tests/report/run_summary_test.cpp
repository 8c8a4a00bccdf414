// SPDX-License-Identifier: Apache-2.0
#include "mesamis/report/run_summary.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "mesamis/report/report.h"
#include "support/shapes.h"

namespace mesamis {
namespace {

Result made_up_result() {
  Result result;
  result.surface = joined(cube(), cube({0.5, 0.5, 0.5}, 1));  // they intersect
  result.mesh.points.resize(5);
  result.mesh.cells.resize(2);
  result.iterations.resize(3);
  result.iterations.back().energy.fidelity = 3;
  result.iterations.back().energy.edge = 2;
  result.parameters.unit_mm = 0.5;
  result.converged = true;
  result.seconds.total = 7;
  result.parameters.tolerance = 0.1;
  return result;
}

TEST(RunSummary, CountsWhatTheResultHolds) {
  const Result result = made_up_result();
  const RunSummary summary = summarize(result, check_surface(result.surface));
  EXPECT_EQ(summary.tets, 2);
  EXPECT_EQ(summary.nodes, 5);
  EXPECT_EQ(summary.triangles, 24);
  EXPECT_EQ(summary.vertices, 16);
  EXPECT_EQ(summary.check.components, 2);
  EXPECT_GT(summary.self_intersections, 0);
  EXPECT_EQ(summary.adaptations(), 2);
  EXPECT_TRUE(summary.converged);
  EXPECT_EQ(summary.seconds.total, 7);
}

TEST(RunSummary, CountsTheMeshThatWasNotKept) {
  Result result = made_up_result();
  result.mesh = {};
  result.iterations.back().tets = 7;
  result.iterations.back().nodes = 6;
  EXPECT_EQ(summarize(result, check_surface(result.surface)).tets, 7);
  EXPECT_EQ(summarize(result, check_surface(result.surface)).nodes, 6);
  result.parameters.preview = true;
  EXPECT_EQ(summarize(result, check_surface(result.surface)).tets, 0) << "the grid is no mesh";
}

TEST(RunSummary, TheEnergyIsInCubicMillimetres) {
  const Result result = made_up_result();
  const RunSummary summary = summarize(result, check_surface(result.surface));
  EXPECT_DOUBLE_EQ(summary.energy_mm3(), 5 * 0.5 * 0.5 * 0.5);
}

TEST(RunSummary, GivesTheReportOfItsResult) {
  const Result result = made_up_result();
  const SurfaceCheck check = check_surface(result.surface);
  EXPECT_EQ(run_json({}, summarize(result, check)), run_json({}, result, check));
}

}  // namespace
}  // namespace mesamis
