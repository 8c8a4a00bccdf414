// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "mesamis/shape_files/surface_files.h"
#include "mesamis/surface/distance.h"
#include "support/level_set.h"
#include "support/run_program.h"
#include "support/shapes.h"

namespace mesamis {
namespace {

using testing::HasSubstr;

/// A ball of radius 8 mm, far from the origin, with a hollow in it and a crumb beside it.
TriMesh hollow_ball_and_crumb() {
  TriMesh ball = level_set({{-1, -1, -1}, {1, 1, 1}}, {20, 20, 20},
                           [](const Vec3& p) { return std::min(0.8 - norm(p), norm(p) - 0.3); });
  for (Vec3& p : ball.points) p = Vec3{100, -50, 900} + 10 * p;
  return joined(ball, cube({120, -50, 900}, 0.5));
}

TEST(DecimateCommand, KeepsItsPromisesAndTellsThem) {
  const TempFolder folder;
  const TriMesh surface = hollow_ball_and_crumb();
  write_surface(folder / "a.ply", surface);
  const ProgramRun run =
      run_program(folder, {"decimate", folder / "a.ply", "-o", folder / "b.3mf", "--tolerance",
                           "0.2", "--report", folder / "r.json", "--quiet"});
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(run.err, "");
  const TriMesh result = read_surface(folder / "b.3mf");
  EXPECT_LT(result.triangles.size(), surface.triangles.size() / 2);
  EXPECT_LE(max_distance(surface, result, 1e-3), 0.2 + 1e-4);  // the file's decimals
  EXPECT_LE(max_distance(result, surface, 1e-3), 0.2 + 1e-4);
  const auto report = nlohmann::json::parse(read_bytes(folder / "r.json"))["surface"];
  EXPECT_EQ(report["triangles"], result.triangles.size());
  EXPECT_LE(report["distance_extracted_to_result_max"], 0.2);
  EXPECT_LE(report["distance_result_to_extracted_max"], 0.2);
  EXPECT_EQ(report["self_intersections"], 0);
  EXPECT_EQ(report["closed"], true);
  EXPECT_EQ(report["components"], 3);
}

TEST(DecimateCommand, KeepsTheFrameStatedOrLeavesItUnstated) {
  const TempFolder folder;
  auto decimate = [&folder](const char* from, const char* to) {
    return run_program(
        folder, {"decimate", folder / from, "-o", folder / to, "--tolerance", "0.01", "--quiet"});
  };
  const TriMesh surface = cube({5, 6, 7}, 2);
  write_surface(folder / "ras.ply", surface, {.frame = Frame::kRas});
  EXPECT_EQ(decimate("ras.ply", "a.ply").status, 0);
  const SurfaceFile turned_back = read_surface_file(folder / "a.ply");
  EXPECT_EQ(turned_back.frame, Frame::kLps);
  EXPECT_EQ(turned_back.surface.points, surface.points);
  write_surface(folder / "none.ply", surface, {.frame = std::nullopt});
  EXPECT_EQ(decimate("none.ply", "b.ply").status, 0);
  const SurfaceFile unstated = read_surface_file(folder / "b.ply");
  EXPECT_EQ(unstated.frame, std::nullopt);
  EXPECT_EQ(unstated.surface.points, surface.points);
}

TEST(DecimateCommand, SaysWhenSinglePrecisionIsTooCoarse) {
  const TempFolder folder;
  write_surface(folder / "far.ply", cube({1'000'000.02, 0.3, 0.3}, 3));
  const ProgramRun run = run_program(folder, {"decimate", folder / "far.ply", "-o",
                                              folder / "b.ply", "--tolerance", "1e-3", "--quiet"});
  EXPECT_EQ(run.status, 4);
  EXPECT_THAT(run.err, HasSubstr("tolerance: expected distances of 0.001 mm at most"));
}

TEST(DecimateCommand, SelectsParts) {
  const TempFolder folder;
  write_surface(folder / "a.ply", hollow_ball_and_crumb());
  const ProgramRun run = run_program(
      folder, {"decimate", folder / "a.ply", "-o", folder / "b.stl", "--triangles", "500",
               "--min-volume", "1", "--fill-cavities", "--report", folder / "r.json"});
  EXPECT_EQ(run.status, 0) << run.err;
  const auto report = nlohmann::json::parse(read_bytes(folder / "r.json"))["surface"];
  EXPECT_EQ(report["triangles"], 500);
  EXPECT_EQ(report["components"], 1);
  EXPECT_EQ(report["parts"]["cavities_filled"], 1);
  EXPECT_EQ(report["parts"]["islands_dropped"], 1);
  EXPECT_NEAR(report["parts"]["volume_dropped_mm3"], 0.125, 1e-9);
}

TEST(DecimateCommand, RefusesInOneLineAndWritesNothing) {
  const TempFolder folder;
  TriMesh open = cube();
  open.triangles.pop_back();
  write_surface(folder / "open.ply", open);
  write_surface(folder / "cube.ply", cube());
  auto decimate = [&folder](const char* name, std::vector<std::string> options) {
    options.insert(options.begin(), {"decimate", folder / name, "-o", folder / "b.stl"});
    return run_program(folder, options);
  };
  EXPECT_FAILS(decimate("open.ply", {"--tolerance", "1"}), 3,
               "expected a closed 2-manifold surface, found 3 open edges");
  EXPECT_FAILS(decimate("cube.ply", {}), 2, "expected --tolerance or --triangles");
  EXPECT_FAILS(decimate("cube.ply", {"--tolerance", "-1"}), 2, "tolerance: expected 0 to");
  EXPECT_FAILS(decimate("cube.ply", {"--tolerance", "1", "--min-volume", "2"}), 3,
               "expected a part of at least --min-volume");
  EXPECT_FALSE(std::filesystem::exists(folder / "b.stl"));
}

}  // namespace
}  // namespace mesamis
