// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <signal.h>

#include <chrono>
#include <cstring>
#include <nlohmann/json.hpp>
#include <thread>

#include "mesamis/io/mesh_files.h"
#include "mesamis/io/surface_files.h"
#include "support/ball_volume.h"
#include "support/run_program.h"

namespace mesamis {
namespace {

using testing::HasSubstr;

constexpr double kRadius = 7;

void write_ball(const TempFolder& folder, Index size) {
  BallVolume ball;
  ball.size = size;
  ball.radius = kRadius;
  const Volume volume = make_ball(ball);
  std::string samples(volume.samples.size() * sizeof(float), '\0');
  std::memcpy(samples.data(), volume.samples.data(), samples.size());
  const std::string n = std::to_string(size);
  write_bytes(folder / "ball.nrrd", "NRRD0004\ntype: float\ndimension: 3\nsizes: " + n + " " + n +
                                        " " + n +
                                        "\nencoding: raw\nendian: little\n"
                                        "space: left-posterior-superior\n"
                                        "space directions: (1,0,0) (0,1,0) (0,0,1)\n"
                                        "space origin: (0,0,0)\n\n" +
                                        samples);
}

std::vector<std::string> segment_arguments(const TempFolder& folder, const std::string& name,
                                           std::vector<std::string> more = {}) {
  std::vector<std::string> arguments{
      "segment", folder / "ball.nrrd",     "-o",       folder / (name + ".stl"),
      "--mesh",  folder / (name + ".vtu"), "--report", folder / (name + ".json")};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

nlohmann::json report_of(const TempFolder& folder, const std::string& name) {
  return nlohmann::json::parse(read_bytes(folder / (name + ".json")));
}

TEST(SegmentCommand, TurnsAScanIntoASurfaceAMeshAndAReportThatRepeatsIt) {
  const TempFolder folder;
  write_ball(folder, 24);
  const std::vector<std::string> options{"--max-tets", "10000", "--quiet"};
  auto one = segment_arguments(folder, "one", options);
  one.insert(one.end(), {"--threads", "1"});
  const ProgramRun run = run_program(folder, one);
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(run.err, "");

  const auto report = report_of(folder, "one");
  EXPECT_EQ(report["surface"]["closed"], true);
  EXPECT_EQ(report["surface"]["manifold"], true);
  EXPECT_EQ(report["surface"]["components"], 1);
  EXPECT_EQ(report["surface"]["parts"]["islands"], 1);
  EXPECT_EQ(report["surface"]["parts"]["cavities"], 0);
  EXPECT_NEAR(report["surface"]["volume_mm3"], 4.0 / 3 * M_PI * std::pow(kRadius, 3), 100);
  const TriMesh surface = read_surface(folder / "one.stl");
  EXPECT_EQ(report["surface"]["triangles"], surface.triangles.size());
  EXPECT_TRUE(check_surface(surface).closed());
  const MeshWithArrays mesh = read_vtu(folder / "one.vtu");
  EXPECT_EQ(report["mesh"]["tets"], mesh.mesh.cells.size());
  EXPECT_NEAR(static_cast<double>(mesh.mesh.cells.size()), 10000, 1000);

  // The settings of the report, on another number of threads: the same bytes.
  const auto again = segment_arguments(
      folder, "two", {"--settings", folder / "one.json", "--threads", "2", "--quiet"});
  EXPECT_EQ(run_program(folder, again).status, 0);
  EXPECT_TRUE(read_bytes(folder / "two.stl") == read_bytes(folder / "one.stl"));
  EXPECT_TRUE(read_bytes(folder / "two.vtu") == read_bytes(folder / "one.vtu"));
  EXPECT_EQ(report_of(folder, "two")["settings"], report["settings"]);
}

TEST(SegmentCommand, WritesTheOtherFrameAndTheBand) {
  const TempFolder folder;
  write_ball(folder, 20);
  const std::vector<std::string> options{"--max-tets", "2000", "--adaptations", "2", "--quiet"};
  auto lps = segment_arguments(folder, "lps", options);
  lps.insert(lps.end(), {"--band-mesh", folder / "band.vtu"});
  auto ras = segment_arguments(folder, "ras", options);
  ras.insert(ras.end(), {"--frame", "ras"});
  const int status = run_program(folder, lps).status;
  EXPECT_THAT(status, testing::AnyOf(0, 4)) << "few adaptations may leave it unsettled";
  EXPECT_EQ(run_program(folder, ras).status, status);
  const TriMesh a = read_surface(folder / "lps.stl"), b = read_surface(folder / "ras.stl");
  ASSERT_EQ(a.points.size(), b.points.size());
  EXPECT_EQ(b.points[3], (Vec3{-a.points[3].x, -a.points[3].y, a.points[3].z}));
  const MeshWithArrays band = read_vtu(folder / "band.vtu");
  const MeshWithArrays whole = read_vtu(folder / "lps.vtu");
  double edge_cells = 0;
  for (const double is_edge : whole.cell_arrays[3].values) edge_cells += is_edge;
  EXPECT_EQ(static_cast<double>(band.mesh.cells.size()), edge_cells);
  EXPECT_GT(edge_cells, 0);
}

TEST(SegmentCommand, RefusesInOneLineAndWritesNothing) {
  const TempFolder folder;
  write_ball(folder, 8);
  EXPECT_FAILS(run_program(folder, segment_arguments(folder, "a", {"--gamma", "-1"})), 2,
               "gamma: expected 1e-12 to 1e+12, found -1");
  EXPECT_FAILS(run_program(folder, segment_arguments(folder, "a", {"--frame", "up"})), 2,
               "up not in {lps,ras}");
  write_bytes(folder / "s.json", "{\"gamma\": -1}");
  EXPECT_FAILS(
      run_program(folder, segment_arguments(folder, "a", {"--settings", folder / "s.json"})), 3,
      "gamma: expected");
  auto outputs = [&folder](const std::string& surface, const std::string& mesh) {
    return run_program(
        folder, {"segment", folder / "ball.nrrd", "-o", folder / surface, "--mesh", folder / mesh});
  };
  EXPECT_FAILS(outputs("a.xyz", "a.vtu"), 2,
               "ends with one of .stl .ply .obj .vtp .3mf .amf, found");
  EXPECT_FAILS(outputs("a.stl", "a.foo"), 2, "ends with one of .vtu .mesh, found");
  EXPECT_FAILS(outputs("none/a.stl", "a.vtu"), 3, "there is no folder");
  for (const auto* option : {"--max-tets", "--adaptations", "--amis-iterations"}) {
    EXPECT_FAILS(run_program(folder, segment_arguments(folder, "a", {option, "300.5"})), 2,
                 "expected a whole number, found 300.5");
  }
  EXPECT_FAILS(run_program(folder, segment_arguments(folder, "a", {"--stride", "1,1,1,"})), 2,
               "--stride");
  EXPECT_FAILS(
      run_program(folder, segment_arguments(folder, "a", {"--window", "900,990", "--quiet"})), 3,
      "window: expected one that holds some of the samples");
  write_bytes(folder / "ball.nrrd", "no scan");
  EXPECT_FAILS(run_program(folder, segment_arguments(folder, "a", {"--quiet"})), 3, "ball.nrrd");
  EXPECT_EQ(folder.file_count(), 4) << "the scan, the settings, stdout and stderr";
}

TEST(SegmentCommand, LeavesNothingBehindWhenInterrupted) {
  const TempFolder folder;
  write_ball(folder, 64);  // far more work than the test waits for
  const pid_t child = start_program(folder, segment_arguments(folder, "a"));
  std::this_thread::sleep_for(std::chrono::milliseconds(700));
  kill(child, SIGINT);
  const ProgramRun run = await_program(folder, child);
  EXPECT_EQ(run.status, -SIGINT);
  EXPECT_THAT(run.err, HasSubstr("interrupted"));
  EXPECT_EQ(folder.file_count(), 3) << "the scan, stdout and stderr";
}

}  // namespace
}  // namespace mesamis
