// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numeric>
#include <sstream>

#include "mesamis/shape_files/object_files.h"
#include "mesamis/shape_files/surface_files.h"
#include "support/run_program.h"
#include "support/shapes.h"
#include "support/test_data.h"

namespace mesamis {
namespace {

/// A square in the plane z = height, as .obj.
std::string square(double height) {
  std::ostringstream text;
  for (const auto* corner : {"0 0 ", "4 0 ", "4 4 ", "0 4 "}) {
    text << "v " << corner << height << "\n";
  }
  text << "f 1 2 3\nf 1 3 4\n";
  return text.str();
}

TEST(CompareCommand, MeasuresParallelSquares) {
  const TempFolder folder;
  write_bytes(folder / "a.obj", square(0));
  write_bytes(folder / "b.obj", square(0.25));
  const ProgramRun run =
      run_program(folder, {"compare", folder / "a.obj", folder / "b.obj", "--report",
                           folder / "r.json", "--histogram", folder / "h.csv"});
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_THAT(run.out, testing::HasSubstr("0.2500"));
  const auto report = nlohmann::json::parse(read_bytes(folder / "r.json"));
  for (const auto* direction : {"surface_to_reference", "reference_to_surface"}) {
    const auto& d = report[direction];
    EXPECT_EQ(d["vertices"], 4);
    for (const auto* figure : {"mean", "rms", "p95", "p99", "max"}) {
      EXPECT_NEAR(d[figure].get<double>(), 0.25, 1e-12) << direction << " " << figure;
      EXPECT_NEAR(d["by_area"][figure].get<double>(), 0.25, 1e-12) << direction << " " << figure;
    }
    EXPECT_GT(d["by_area"]["samples"], 1000);
  }
}

TEST(CompareCommand, PrintsMicronsWithAsManyDigits) {
  const TempFolder folder;
  write_bytes(folder / "a.obj", square(0));
  write_bytes(folder / "b.obj", square(0.0006254));
  const ProgramRun run = run_program(folder, {"compare", folder / "a.obj", folder / "b.obj"});
  EXPECT_THAT(run.out, testing::HasSubstr(" 0.0006254 0.0006254 0.0006254 "));
}

TEST(CompareCommand, MeasuresInsideABoxAlone) {
  const TempFolder folder;
  write_bytes(folder / "a.obj", square(0));
  const std::string far = "v 10 0 3\nv 14 0 3\nv 14 4 3\nf 5 6 7\n";
  write_bytes(folder / "b.obj", square(0.25) + far);
  const auto compare = [&folder](const std::string& box) {
    return run_program(folder, {"compare", folder / "a.obj", folder / "b.obj", "--box", box,
                                "--report", folder / "r.json"});
  };
  EXPECT_EQ(compare("-1,-1,-1,5,5,5").status, 0);
  const auto report = nlohmann::json::parse(read_bytes(folder / "r.json"));
  EXPECT_EQ(report["surface_to_reference"]["vertices"], 4);
  EXPECT_NEAR(report["surface_to_reference"]["by_area"]["max"], 0.25, 1e-12);
  EXPECT_EQ(report["box"], nlohmann::json({-1, -1, -1, 5, 5, 5}));
  EXPECT_EQ(compare("-1:5,:5,-1:").status, 0);
  EXPECT_EQ(nlohmann::json::parse(read_bytes(folder / "r.json"))["surface_to_reference"],
            report["surface_to_reference"]);
  EXPECT_FAILS(compare("0,0,0,0,1,1"), 2, "--box");
  EXPECT_FAILS(compare("20,20,20,21,21,21"), 3, "inside the box");
}

/// Two cubes beside each other, as objects of these names.
void write_cubes(const std::string& path, const char* left, const char* right) {
  write_objects(path, std::vector<NamedSurface>{{left, {1, 2, 3}, 1, cube({0, 0, 0}, 4)},
                                                {right, {4, 5, 6}, 2, cube({9, 1, 2}, 4)}});
}

TEST(CompareCommand, MeasuresObjectsOfOneNameOnTheirOwn) {
  const TempFolder folder;
  const std::string report = folder / "r.json";
  for (const char* format : {".3mf", ".vtp", ".obj", ".amf"}) {
    const std::string a = folder / ("a" + std::string(format)), b = folder / "b.vtp";
    write_cubes(a, "left", "right");
    write_cubes(b, "right", "left");
    const ProgramRun run = run_program(folder, {"compare", a, b, "--report", report});
    EXPECT_EQ(run.status, 0) << run.err;
    EXPECT_EQ(run.err, "");
    EXPECT_THAT(run.out, testing::HasSubstr("\nleft\nsurface_to_reference "));
    const auto found = nlohmann::json::parse(read_bytes(report));
    EXPECT_NEAR(found["surface_to_reference"]["max"], 0, 1e-5) << "together they are the same";
    ASSERT_EQ(found["objects"].size(), 2);
    EXPECT_EQ(found["objects"][0]["name"], "left");
    for (const auto& object : found["objects"]) {
      EXPECT_GT(object["surface_to_reference"]["by_area"]["mean"], 3);
      EXPECT_GT(object["reference_to_surface"]["mean"], 3);
    }
  }
}

TEST(CompareCommand, SaysThatObjectsAreMeasuredTogether) {
  const TempFolder folder;
  write_cubes(folder / "a.3mf", "left", "right");
  write_cubes(folder / "b.3mf", "one", "two");
  write_surface(folder / "one.ply", cube({0, 0, 0}, 4));
  const auto compare = [&](const char* reference, const char* surface) {
    return run_program(
        folder, {"compare", folder / reference, folder / surface, "--report", folder / "r.json"});
  };
  const auto line = testing::HasSubstr("a.3mf: 2 objects, measured together as one surface");
  for (const ProgramRun& run :
       {compare("a.3mf", "one.ply"), compare("one.ply", "a.3mf"), compare("a.3mf", "b.3mf")}) {
    EXPECT_EQ(run.status, 0) << run.err;
    EXPECT_THAT(run.err, line);
    EXPECT_FALSE(nlohmann::json::parse(read_bytes(folder / "r.json")).contains("objects"));
  }
  EXPECT_EQ(compare("one.ply", "one.ply").err, "");
}

TEST(CompareCommand, HistogramCountsEveryPoint) {
  const TempFolder folder;
  write_bytes(folder / "a.obj", square(0));
  write_bytes(folder / "b.obj", "v 0 0 0\nv 4 0 1\nv 0 4 2\nf 1 2 3\n");
  const ProgramRun run = run_program(
      folder, {"compare", folder / "a.obj", folder / "b.obj", "--histogram", folder / "h.csv"});
  EXPECT_EQ(run.status, 0) << run.err;
  std::istringstream csv(read_bytes(folder / "h.csv"));
  std::string line;
  std::getline(csv, line);
  EXPECT_EQ(line,
            "from_mm,to_mm,surface_to_reference_vertices,surface_to_reference_area,"
            "reference_to_surface_vertices,reference_to_surface_area");
  std::array<long, 2> vertices{};
  double last = 0;
  while (std::getline(csv, line)) {
    double from = 0, to = 0;
    long a = 0, b = 0, c = 0, d = 0;
    ASSERT_EQ(std::sscanf(line.c_str(), "%lf,%lf,%ld,%ld,%ld,%ld", &from, &to, &a, &b, &c, &d), 6);
    EXPECT_NEAR(from, last, 1e-4);
    last = to;
    vertices[0] += a;
    vertices[1] += c;
  }
  EXPECT_EQ(vertices, (std::array<long, 2>{3, 4}));
}

TEST(CompareCommand, RefusesPlainly) {
  const TempFolder folder;
  write_bytes(folder / "a.obj", square(0));
  const std::string a = folder / "a.obj";
  EXPECT_FAILS(run_program(folder, {"compare", a, a, "--colored", "c.ply"}), 2, ".vtp");
  EXPECT_FAILS(run_program(folder, {"compare", a, a, "--frames", "lps"}), 2, "lps");
  EXPECT_FAILS(run_program(folder, {"compare", a, folder / "none.obj"}), 3, "none.obj");
  EXPECT_FAILS(run_program(folder, {"compare", a}), 2, "surface");
}

/// A box far from the origin in LPS, 20 by 30 by 40 mm.
TriMesh head() {
  TriMesh surface = cube({0, 0, 0}, 10);
  for (Vec3& p : surface.points) p = {15 + 2 * p.x, -170 + 3 * p.y, 600 + 4 * p.z};
  return surface;
}

TEST(CompareCommand, DirectionsChangePlacesWithTheSurfaces) {
  const TempFolder folder;
  write_surface(folder / "a.ply", head());
  TriMesh other = head();
  other.points[7] = other.points[7] + Vec3{3, 1, 2};
  write_surface(folder / "b.ply", other);
  const auto compare = [&](const char* reference, const char* surface) {
    run_program(folder,
                {"compare", folder / reference, folder / surface, "--report", folder / "r.json"});
    return nlohmann::json::parse(read_bytes(folder / "r.json"));
  };
  const auto ab = compare("a.ply", "b.ply"), ba = compare("b.ply", "a.ply");
  EXPECT_EQ(ab["surface_to_reference"], ba["reference_to_surface"]);
  EXPECT_EQ(ab["reference_to_surface"], ba["surface_to_reference"]);
  EXPECT_NEAR(ab["surface_to_reference"]["max"], std::sqrt(14), 1e-9);
  // (14)-(16) of the paper: from the vertices of the reference.
  EXPECT_EQ(ab["paper"]["hausdorff"], ab["reference_to_surface"]["max"]);
  EXPECT_EQ(ab["paper"]["average_hausdorff"], ab["reference_to_surface"]["mean"]);
  EXPECT_EQ(ab["paper"]["least_local"], 0);
  const auto aa = compare("a.ply", "a.ply");
  for (const auto* figure : {"mean", "rms", "p95", "p99", "max"}) {
    EXPECT_EQ(aa["surface_to_reference"][figure], 0) << figure;
    EXPECT_LT(aa["surface_to_reference"]["by_area"][figure], 1e-10) << figure;
  }
}

TEST(CompareCommand, ColoursTheSurfaceByTheDistanceOfItsVertices) {
  const TempFolder folder;
  write_surface(folder / "a.ply", head());
  TriMesh shifted = head();
  for (Vec3& p : shifted.points) p.z += 2;
  shifted.points.push_back({0, 0, 0});  // of no triangle: no vertex
  for (const Frame frame : {Frame::kLps, Frame::kRas}) {
    write_surface(folder / "b.ply", shifted, {.frame = frame});
    const ProgramRun run =
        run_program(folder, {"compare", folder / "a.ply", folder / "b.ply", "--colored",
                             folder / "c.vtp", "--report", folder / "r.json"});
    EXPECT_EQ(run.status, 0) << run.err;
    const SurfaceFile colored = read_surface_file(folder / "c.vtp");
    EXPECT_EQ(colored.frame, Frame::kLps) << "that of the reference";
    EXPECT_EQ(colored.surface.triangles, shifted.triangles);
    const auto distances = read_point_array(folder / "c.vtp", "distance");
    ASSERT_EQ(distances.size(), 8u);
    for (std::size_t i = 0; i < 8; ++i) {
      EXPECT_EQ(colored.surface.points[i], shifted.points[i]);
      EXPECT_NEAR(distances[i], i < 4 ? 0 : 2, 1e-9) << "only the top is off";
    }
    const auto report = nlohmann::json::parse(read_bytes(folder / "r.json"));
    EXPECT_EQ(report["surface_to_reference"]["vertices"], 8);
  }
}

TEST(CompareCommand, TurnsWhatStatesAnotherFrameAndSaysSo) {
  const TempFolder folder;
  for (const auto& [name, frame] : {std::pair{"lps.stl", Frame::kLps}, {"ras.vtp", Frame::kRas}}) {
    write_surface(folder / name, head(), {.frame = frame});
  }
  const ProgramRun run = run_program(
      folder, {"compare", folder / "ras.vtp", folder / "lps.stl", "--report", folder / "r.json"});
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(run.error_lines(), 1u);
  EXPECT_THAT(run.err, testing::HasSubstr("turned from LPS to RAS"));
  const auto report = nlohmann::json::parse(read_bytes(folder / "r.json"));
  EXPECT_LT(report["surface_to_reference"]["max"], 1e-4);
  EXPECT_EQ(report["frames"]["reference"], "RAS");
  EXPECT_EQ(report["frames"]["surface"], "LPS");
  EXPECT_EQ(report["frames"]["surface_turned"], true);
  EXPECT_TRUE(report["frames"]["fits_better_flipped"].is_null());
}

TEST(CompareCommand, RefusesWhatOnlyFitsAfterAFlip) {
  const TempFolder folder;
  write_surface(folder / "a.ply", head());
  write_surface(folder / "silent.ply", turned(head()), {.frame = {}});
  write_surface(folder / "liar.ply", turned(head()));
  TriMesh mirrored = head();
  for (Vec3& p : mirrored.points) p.z = -p.z;
  write_surface(folder / "mirrored.ply", mirrored);
  const std::string a = folder / "a.ply", report = folder / "r.json";
  const auto compare = [&](const char* name, const std::string& rule) {
    return run_program(folder, {"compare", a, folder / name, "--frames", rule, "--report", report});
  };
  for (const auto* name : {"silent.ply", "liar.ply"}) {
    EXPECT_FAILS(compare(name, "auto"), 3, "(-x, -y, z)");
    EXPECT_FAILS(compare(name, "auto"), 3, "15,-170,600 to 35,-140,640");
    EXPECT_FAILS(compare(name, "auto"), 3, "-35,140,600 to -15,170,640");
    EXPECT_FALSE(std::filesystem::exists(report));
    EXPECT_EQ(compare(name, "turned").status, 0);
    EXPECT_EQ(nlohmann::json::parse(read_bytes(report))["surface_to_reference"]["max"], 0);
    EXPECT_EQ(compare(name, "as-is").status, 0);
    EXPECT_GT(nlohmann::json::parse(read_bytes(report))["surface_to_reference"]["mean"], 200);
    std::filesystem::remove(report);
  }
  EXPECT_FAILS(compare("mirrored.ply", "auto"), 3, "(x, y, -z)");
}

TEST(CompareCommand, RealPelvisIsRefusedFlippedAndOnlyThen) {
  const auto labels = test_data("data/pelvis_ts/bone.nii.gz");
  MESAMIS_REQUIRE_DATA(labels);
  const TempFolder folder;
  run_program(folder, {"baseline", labels, "--level", "0.5", "-o", folder / "a.ply"});
  run_program(folder, {"baseline", labels, "--level", "0.5", "--smooth", "1", "--triangles",
                       "30000", "-o", folder / "b.ply"});
  const TriMesh other = read_surface(folder / "b.ply");
  write_surface(folder / "flipped.ply", turned(other), {.frame = {}});
  // A part: what lies above the middle.
  TriMesh part{other.points, {}};
  for (const Triangle& t : other.triangles) {
    if (other.points[t[0]].z > 260) part.triangles.push_back(t);
  }
  write_surface(folder / "part.ply", part);
  for (const auto* name : {"b.ply", "part.ply"}) {
    const ProgramRun run = run_program(folder, {"compare", folder / "a.ply", folder / name});
    EXPECT_EQ(run.status, 0) << run.err;
    EXPECT_EQ(run.err, "");
  }
  EXPECT_FAILS(run_program(folder, {"compare", folder / "a.ply", folder / "flipped.ply"}), 3,
               "LPS to RAS");
}

TEST(CompareCommand, SaysTheSameForAnyNumberOfThreads) {
  const TempFolder folder;
  write_surface(folder / "a.ply", head());
  write_surface(folder / "b.ply", random_triangles(200, {40, 40, 40}));
  const auto compare = [&](const char* threads) {
    return run_program(folder, {"compare", folder / "a.ply", folder / "b.ply", "--threads", threads,
                                "--colored", folder / (std::string(threads) + ".vtp")});
  };
  EXPECT_EQ(compare("1").out, compare("3").out);
  EXPECT_EQ(read_bytes(folder / "1.vtp"), read_bytes(folder / "3.vtp"));
}

}  // namespace
}  // namespace mesamis
