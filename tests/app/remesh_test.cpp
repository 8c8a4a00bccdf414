// SPDX-License-Identifier: Apache-2.0
#include "mesamis/remesh/remesh.h"

#include <gmock/gmock.h>
#include <signal.h>

#include <chrono>
#include <nlohmann/json.hpp>
#include <thread>

#include "mesamis/mesh/metric.h"
#include "mesamis/shape_files/mesh_files.h"
#include "support/metric_fields.h"
#include "support/run_program.h"

namespace mesamis {
namespace {

using testing::HasSubstr;

/// A cube with the metric of one edge length on one side and another on the other.
void write_cube(const TempFolder& folder, double left, double right) {
  const TetMesh mesh = box_mesh({{0, 0, 0}, {1, 1, 1}}, {3, 3, 3});
  std::vector<Sym3> metrics;
  for (const Vec3& p : mesh.points) {
    const double h = p.x < 0.5 ? left : right;
    metrics.push_back(1 / (h * h) * kIdentity3);
  }
  write_medit_mesh(folder / "a.mesh", mesh);
  write_medit_metric(folder / "a.sol", metrics);
}

std::vector<std::string> remesh_arguments(const TempFolder& folder) {
  return {"remesh", folder / "a.mesh", "--metric", folder / "a.sol", "-o", folder / "b.mesh"};
}

/// The report's worst cell and edges are where it says, counted from 1.
void expect_worst_named(const nlohmann::json& report, const TetMesh& mesh) {
  EXPECT_EQ(report["worst_cell"]["quality"], report["quality_min"]);
  const Cell& worst = mesh.cells.at(report["worst_cell"]["tetrahedron"].get<std::size_t>() - 1);
  const auto [a, b, c, d] = cell_corners(mesh, worst);
  EXPECT_NEAR(report["worst_cell"]["middle"][0], (a.x + b.x + c.x + d.x) / 4, 1e-12);
  for (const char* name : {"shortest", "longest"}) {
    const auto& edge = report[name + std::string("_edge")];
    const Vec3 p = mesh.points.at(edge["vertices"][0].get<std::size_t>() - 1);
    const Vec3 q = mesh.points.at(edge["vertices"][1].get<std::size_t>() - 1);
    EXPECT_NEAR(edge["middle"][2], (p.z + q.z) / 2, 1e-12);
  }
  EXPECT_EQ(report["shortest_edge"]["length"], report["edge_length_min"]);
  EXPECT_EQ(report["longest_edge"]["length"], report["edge_length_max"]);
}

TEST(RemeshCommand, AdaptsACubeAndReports) {
  const TempFolder folder;
  write_cube(folder, 0.15, 0.4);
  auto arguments = remesh_arguments(folder);
  arguments.insert(arguments.end(), {"--report", folder / "r.json", "--threads", "1", "--quiet"});
  const ProgramRun run = run_program(folder, arguments);
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(run.err, "");
  const TetMesh mesh = read_medit_mesh(folder / "b.mesh");
  EXPECT_EQ(find_flaw(mesh, {{0, 0, 0}, {1, 1, 1}}), "");
  std::ptrdiff_t left = 0;
  for (const Vec3& p : mesh.points) left += p.x < 0.5;
  EXPECT_GT(left, 2 * (std::ssize(mesh.points) - left)) << "smaller edges on the left";
  const auto report = nlohmann::json::parse(read_bytes(folder / "r.json"));
  EXPECT_EQ(report["program"]["name"], "mesamis");
  EXPECT_EQ(report["mesh"]["tets"], mesh.cells.size());
  EXPECT_EQ(report["mesh"]["nodes"], mesh.points.size());
  EXPECT_EQ(report["converged"], true);
  EXPECT_GT(report["mesh"]["edge_unit_fraction"], 0.8);
  expect_worst_named(report["mesh"], mesh);
  EXPECT_GT(report["peak_memory_mb"], 1);
  EXPECT_THAT(run.out, HasSubstr(std::to_string(mesh.cells.size()) + " tetrahedra"));
}

/// Known at nodes only and sampled anew between passes, a metric is met as well as when it is
/// known everywhere.
TEST(RemeshCommand, ThreePassesWithANodalMetricFitAsWellAsTheMetricItself) {
  const FormulaMetric metric = ugawg_metric(Ugawg::kPolar2, ugawg_scale(Ugawg::kPolar2, 8'000));
  const TetMesh direct = remesh(box_mesh(kUnitBox, {3, 3, 3}), metric);
  const TempFolder folder;
  TetMesh mesh = box_mesh(kUnitBox, {12, 12, 12});
  for (int pass = 0; pass < 3; ++pass) {
    write_medit_mesh(folder / "a.mesh", mesh);
    write_medit_metric(folder / "a.sol", metrics_at_nodes(mesh, metric));
    const ProgramRun run = run_program(folder, remesh_arguments(folder));
    ASSERT_EQ(run.status, 0) << run.err;
    mesh = read_medit_mesh(folder / "b.mesh");
  }
  EXPECT_EQ(find_flaw(mesh, kUnitBox), "");
  const MeshFit fit = measure_fit(mesh, metrics_at_nodes(mesh, metric));
  const MeshFit direct_fit = measure_fit(direct, metrics_at_nodes(direct, metric));
  EXPECT_GT(fit.unit_edge_fraction, direct_fit.unit_edge_fraction - 0.02);
  EXPECT_GT(fit.quality_mean, direct_fit.quality_mean - 0.02);
}

TEST(RemeshCommand, RefusesWhatDoesNotFit) {
  const TempFolder folder;
  write_cube(folder, 0.3, 0.3);
  const auto arguments = remesh_arguments(folder);
  write_medit_metric(folder / "a.sol", std::vector<Sym3>(3, kIdentity3));
  EXPECT_FAILS(run_program(folder, arguments), 3, "found 3");
  write_medit_metric(folder / "a.sol", std::vector<Sym3>(64, -1 * kIdentity3));
  EXPECT_FAILS(run_program(folder, arguments), 3, "a.sol");
  TetMesh open = box_mesh({{0, 0, 0}, {1, 1, 1}}, {1, 1, 1});
  open.cells.pop_back();
  write_medit_mesh(folder / "a.mesh", open);
  EXPECT_FAILS(run_program(folder, arguments), 3, "not a mesh of its bounding box");
  write_bytes(folder / "a.mesh", "MeshVersionFormatted 2\nDimension 3\nVertices\n9999999\n0 0");
  EXPECT_FAILS(run_program(folder, arguments), 3, "a.mesh:4: Vertices");
  EXPECT_FALSE(std::filesystem::exists(folder / "b.mesh"));
}

TEST(RemeshCommand, LeavesNothingBehindWhenInterrupted) {
  const TempFolder folder;
  write_cube(folder, 0.004, 0.004);  // far more work than the test waits for
  const pid_t child = start_program(folder, remesh_arguments(folder));
  std::this_thread::sleep_for(std::chrono::milliseconds(700));
  kill(child, SIGINT);
  const ProgramRun run = await_program(folder, child);
  EXPECT_EQ(run.status, -SIGINT);
  EXPECT_THAT(run.err, HasSubstr("interrupted"));
  EXPECT_EQ(folder.file_count(), 4) << "the mesh, the metric, stdout and stderr";
}

}  // namespace
}  // namespace mesamis
