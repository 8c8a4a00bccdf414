// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <array>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "mesamis/shape_files/object_files.h"
#include "mesamis/shape_files/surface_files.h"
#include "mesamis/surface/distance.h"
#include "support/level_set.h"
#include "support/run_program.h"
#include "support/shapes.h"

namespace mesamis {
namespace {

using testing::HasSubstr;
using testing::Not;

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

/// Each triangle cut into four.
TriMesh finer(const TriMesh& surface) {
  TriMesh result{surface.points, {}};
  std::map<std::array<Index, 2>, Index> middles;
  const auto middle = [&](Index a, Index b) {
    const auto next = static_cast<Index>(result.points.size());
    const auto [found, added] = middles.try_emplace({std::min(a, b), std::max(a, b)}, next);
    if (added) result.points.push_back(0.5 * (surface.points[a] + surface.points[b]));
    return found->second;
  };
  for (const auto& [a, b, c] : surface.triangles) {
    const Index ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
    result.triangles.insert(result.triangles.end(),
                            {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
  }
  return result;
}

/// Two cubes of many triangles, the second on the first: they share a face.
std::vector<NamedSurface> cubes_on_each_other() {
  return {{"lower", {10, 20, 30}, 7, finer(finer(cube({0, 0, -2}, 4)))},
          {"upper", {40, 50, 60}, 3, finer(finer(cube({0, 0, 2}, 4)))}};
}

std::set<std::array<double, 3>> places(const TriMesh& surface, double z) {
  std::set<std::array<double, 3>> places;
  for (const Vec3& p : surface.points) {
    if (p.z == z) places.insert({p.x, p.y, p.z});
  }
  return places;
}

TEST(DecimateCommand, KeepsEachObjectOfAFileWithWhatItShares) {
  const TempFolder folder;
  const std::vector<NamedSurface> objects = cubes_on_each_other();
  for (const char* from : {"a.3mf", "a.amf", "a.vtp", "a.obj"}) {
    write_objects(folder / from, objects);
    for (const char* to : {"b.3mf", "b.amf", "b.vtp", "b.obj"}) {
      const ProgramRun run =
          run_program(folder, {"decimate", folder / from, "-o", folder / to, "--tolerance", "0.05",
                               "--report", folder / "r.json", "--quiet"});
      EXPECT_EQ(run.status, 0) << run.err;
      const ObjectFile file = read_object_file(folder / to);
      const auto report = nlohmann::json::parse(read_bytes(folder / "r.json"))["surfaces"];
      ASSERT_EQ(file.objects.size(), 2) << from << " " << to;
      EXPECT_TRUE(file.coloured);
      for (std::size_t n = 0; n < 2; ++n) {
        const NamedSurface &before = objects[n], &after = file.objects[n];
        EXPECT_EQ(after.name, before.name);
        EXPECT_EQ(after.label, before.label);
        EXPECT_EQ(after.colour, before.colour);
        EXPECT_EQ(flaws_of(check_surface(after.surface)), "");
        EXPECT_LT(after.surface.triangles.size(), before.surface.triangles.size() / 2);
        EXPECT_LE(max_distance(before.surface, after.surface, 1e-3), 0.05 + 1e-4);
        EXPECT_LE(max_distance(after.surface, before.surface, 1e-3), 0.05 + 1e-4);
        EXPECT_EQ(report[n]["name"], before.name);
        EXPECT_EQ(report[n]["triangles"], after.surface.triangles.size());
        EXPECT_LE(report[n]["distance_extracted_to_result_max"], 0.05);
        EXPECT_EQ(report[n]["self_intersections"], 0);
      }
      const auto shared = places(file.objects[0].surface, 2);
      EXPECT_GE(shared.size(), 4);
      EXPECT_EQ(shared, places(file.objects[1].surface, 2));
    }
  }
}

TEST(DecimateCommand, WritesAFileOfEachObjectWhereAFormatHoldsOne) {
  const TempFolder folder;
  write_objects(folder / "a.3mf", cubes_on_each_other());
  const ProgramRun run = run_program(folder, {"decimate", folder / "a.3mf", "-o", folder / "b.stl",
                                              "--triangles", "100", "--quiet"});
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("lower: "));
  EXPECT_FALSE(std::filesystem::exists(folder / "b.stl"));
  EXPECT_EQ(run_program(folder, {"decimate", folder / "b-lower.stl", "-o", folder / "{label}.stl",
                                 "--triangles", "50", "--quiet"})
                .status,
            0);
  for (const char* name : {"b-lower.stl", "b-upper.stl", "object_1.stl"}) {
    EXPECT_EQ(flaws_of(check_surface(read_surface(folder / name))), "") << name;
  }
}

TEST(DecimateCommand, SaysThatTheToleranceCameBeforeTheTriangles) {
  const TempFolder folder;
  write_surface(folder / "a.ply", hollow_ball_and_crumb());
  write_objects(folder / "a.vtp", cubes_on_each_other());
  const auto decimate = [&](const char* from, const char* triangles, const char* tolerance) {
    return run_program(folder, {"decimate", folder / from, "-o", folder / "b.vtp", "--triangles",
                                triangles, "--tolerance", tolerance});
  };
  const ProgramRun stopped = decimate("a.ply", "500", "0.01");
  EXPECT_EQ(stopped.status, 0);
  EXPECT_THAT(stopped.err, HasSubstr("triangles: expected 500 at most, found "));
  EXPECT_THAT(stopped.err, HasSubstr(": the tolerance of 0.01 mm was reached first"));
  EXPECT_THAT(decimate("a.ply", "500", "5").err, Not(HasSubstr("triangles:")));
  // Two cubes of 12 triangles, two of them shared.
  EXPECT_THAT(decimate("a.vtp", "22", "0.01").err, Not(HasSubstr("triangles:")));
  EXPECT_THAT(decimate("a.vtp", "10", "0.01").err, HasSubstr("expected 10 at most, found 22: "));
}

TEST(DecimateCommand, SelectsPartsOfEachObject) {
  const TempFolder folder;
  std::vector<NamedSurface> objects = cubes_on_each_other();
  objects.push_back({"crumb", {1, 2, 3}, 9, cube({20, 0, 0}, 0.1)});
  write_objects(folder / "a.vtp", objects);
  const ProgramRun run = run_program(folder, {"decimate", folder / "a.vtp", "-o", folder / "b.vtp",
                                              "--tolerance", "0.05", "--min-volume", "1"});
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_THAT(run.err, HasSubstr("crumb: no part of at least --min-volume"));
  EXPECT_EQ(read_objects(folder / "b.vtp").size(), 2);
}

TEST(DecimateCommand, TakesOpenPartsOfAClosedSurfaceAsOne) {
  const TempFolder folder;
  write_bytes(folder / "a.obj",
              "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n"
              "g a\nf 1 3 2\nf 1 2 4\ng b\nf 2 3 4\nf 1 4 3\n");
  const std::vector<std::string> words{"decimate",       folder / "a.obj", "-o",
                                       folder / "b.obj", "--tolerance",    "0.2"};
  const ProgramRun run = run_program(folder, words);
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_THAT(run.err, HasSubstr("parts that are not closed, taken as one surface"));
  EXPECT_EQ(flaws_of(check_surface(read_surface(folder / "b.obj"))), "");
}

}  // namespace
}  // namespace mesamis
