// SPDX-License-Identifier: Apache-2.0
#include "mesamis/run/segment.h"

#include <gmock/gmock.h>
#include <signal.h>

#include <algorithm>
#include <chrono>
#include <cstring>
#include <nlohmann/json.hpp>
#include <thread>

#include "mesamis/run/write.h"
#include "mesamis/shape_files/mesh_files.h"
#include "mesamis/shape_files/surface_files.h"
#include "mesamis/surface/self_intersections.h"
#include "mesamis/volume_files/read_volume.h"
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

/// The program only translates: its files are those that the library writes for the same request.
TEST(SegmentCommand, WritesTheBytesOfTheLibrary) {
  const TempFolder folder;
  write_ball(folder, 20);
  const std::vector<std::string> names{"a.stl", "a.vtp", "a.3mf", "a.vtu", "a.nii.gz"};
  std::vector<std::string> arguments{
      "segment", folder / "ball.nrrd", "--max-tets", "2000", "--adaptations", "2", "--quiet",
      "--error"};
  for (const char* option : {"-o", "-o", "-o", "--mesh", "--labelmap"}) {
    const std::string& name = names[(arguments.size() - 8) / 2];
    arguments.insert(arguments.end(), {option, folder / name});
  }
  ASSERT_EQ(run_program(folder, arguments).status, 0);
  Request request;
  request.scan = read_volume(folder / "ball.nrrd").volume;
  request.settings.max_tets = 2000;
  request.settings.adaptations = 2;
  const TempFolder other;
  Outputs out;
  out.surfaces = {other / "a.stl", other / "a.vtp", other / "a.3mf"};
  out.meshes = {other / "a.vtu"};
  out.labelmap = other / "a.nii.gz";
  out.error = true;
  write(segment(std::move(request)), out);
  for (const std::string& name : names) {
    EXPECT_EQ(read_bytes(folder / name), read_bytes(other / name)) << name;
  }
}

TEST(SegmentCommand, TurnsAScanIntoASurfaceAMeshAndAReportThatRepeatsIt) {
  const TempFolder folder;
  write_ball(folder, 24);
  const std::vector<std::string> options{"--max-tets", "5000", "--quiet"};
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
  EXPECT_NEAR(static_cast<double>(mesh.mesh.cells.size()), 5000, 500);

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

const std::vector<double>& array_of(const std::vector<MeshArray>& arrays, const std::string& name) {
  for (const MeshArray& array : arrays) {
    if (array.name == name) return array.values;
  }
  throw std::runtime_error("no array " + name);
}

double volume_of(const TetMesh& mesh) {
  double sum = 0;
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    sum += cell_volume(mesh, static_cast<Index>(c));
  }
  return sum;
}

TEST(SegmentCommand, WritesTheObjectAloneInBinsTheSameForAnyNumberOfThreads) {
  const TempFolder folder;
  write_ball(folder, 20);
  const auto run = [&folder](const std::string& name, const std::string& threads) {
    return run_program(
        folder,
        segment_arguments(folder, name,
                          {"--mesh", folder / (name + ".msh"), "--mesh", folder / (name + ".inp"),
                           "--mesh", folder / (name + ".mesh"), "--mesh-region", "object", "--bins",
                           "6", "--max-tets", "4000", "--quiet", "--threads", threads}));
  };
  const ProgramRun first = run("one", "1");
  EXPECT_EQ(first.status, 0) << first.err;
  EXPECT_EQ(run("two", "2").status, 0);
  for (const auto* extension : {".vtu", ".msh", ".inp", ".mesh", ".sol"}) {
    EXPECT_EQ(read_bytes(folder / (std::string("one") + extension)),
              read_bytes(folder / (std::string("two") + extension)));
  }

  const auto report = report_of(folder, "one");
  const auto region = report["mesh"]["region"];
  const MeshWithArrays object = read_vtu(folder / "one.vtu");
  EXPECT_EQ(region["name"], "object");
  EXPECT_EQ(region["cells"], object.mesh.cells.size());
  EXPECT_EQ(region["nodes"], object.mesh.points.size());
  EXPECT_EQ(region["components"], 1);
  EXPECT_LT(object.mesh.cells.size(), report["mesh"]["tets"].get<std::size_t>());
  EXPECT_EQ(read_medit_mesh(folder / "one.mesh").cells, object.mesh.cells);
  // Cut cells count for half, so that the volume is right in the mean.
  const double volume = volume_of(object.mesh);
  EXPECT_NEAR(region["volume_mm3"], volume, 1e-6 * volume);
  EXPECT_NEAR(volume / report["surface"]["volume_mm3"].get<double>(), 1, 0.02);
  const double middle = 4.0 / 3 * M_PI * std::pow(middle_radius(kRadius, 1), 3);
  EXPECT_NEAR(volume / middle, 1, 0.05);

  const auto& native = array_of(object.cell_arrays, "native");
  const auto& bin = array_of(object.cell_arrays, "bin");
  ASSERT_EQ(region["bins"].size(), 6u);
  std::vector<std::size_t> counts(6, 0);
  for (std::size_t c = 0; c < native.size(); ++c) {
    const auto b = static_cast<std::size_t>(bin[c]) - 1;
    ASSERT_LT(b, 6u);
    ++counts[b];
    EXPECT_GE(native[c], region["bins"][b]["native"][0].get<double>());
    EXPECT_LE(native[c], region["bins"][b]["native"][1].get<double>());
  }
  for (std::size_t b = 0; b < 6; ++b) EXPECT_EQ(region["bins"][b]["cells"], counts[b]);
}

TEST(SegmentCommand, WritesTheErrorItExpects) {
  const TempFolder folder;
  write_ball(folder, 24);
  const ProgramRun run = run_program(
      folder, {"segment", folder / "ball.nrrd", "-o", folder / "a.vtp", "-o", folder / "a.ply",
               "--error", "--report", folder / "a.json", "--max-tets", "10000", "--quiet"});
  EXPECT_EQ(run.status, 0) << run.err;
  const auto errors = read_point_array(folder / "a.vtp", "expected_error");
  EXPECT_EQ(errors, read_point_array(folder / "a.ply", "expected_error"));
  const auto told = report_of(folder, "a")["quality"]["expected_error_mm"];
  const auto [least, most] = std::minmax_element(errors.begin(), errors.end());
  EXPECT_GT(*least, 0);
  EXPECT_LT(*least, told["mean"]);
  EXPECT_LE(told["mean"], told["max"]);
  EXPECT_LE(told["max"], *most);
  // Of normal variables of one mean size 95 % are less than 2.456 times that.
  EXPECT_GE(told["p95"], 2.4 * told["mean"].get<double>());
  EXPECT_LE(told["p95"], 2.46 * told["max"].get<double>());
}

TEST(SegmentCommand, IsAsFineAsWasAskedForOrSaysThatTheScanIsNot) {
  const TempFolder folder;
  write_ball(folder, 24);
  const auto run_for = [&](const std::string& name, const std::string& accuracy) {
    return run_program(folder,
                       segment_arguments(folder, name, {"--accuracy", accuracy, "--quiet"}));
  };
  EXPECT_EQ(run_for("coarse", "1").status, 0);
  EXPECT_EQ(run_for("fine", "0.2").status, 0);
  const auto coarse = report_of(folder, "coarse"), fine = report_of(folder, "fine");
  EXPECT_LT(coarse["surface"]["triangles"], fine["surface"]["triangles"]);
  EXPECT_EQ(coarse["settings"]["tolerance"], 0.5);
  EXPECT_EQ(fine["given"], nlohmann::json{"accuracy"});
  const ProgramRun unmet = run_for("unmet", "0.001");
  EXPECT_EQ(unmet.status, 4);
  EXPECT_THAT(unmet.err, HasSubstr("accuracy: expected 0.001 mm in the mean at most, found 0."));
  EXPECT_EQ(report_of(folder, "unmet")["surface"]["closed"], true) << "written all the same";
}

TEST(SegmentCommand, PreviewsWithoutAMesh) {
  const TempFolder folder;
  write_ball(folder, 24);
  const ProgramRun run = run_program(
      folder, {"segment", folder / "ball.nrrd", "--preview", "-o", folder / "a.stl", "-o",
               folder / "a.vtp", "-o", folder / "a.ply", "--report", folder / "a.json", "--quiet"});
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_THAT(read_bytes(folder / "a.stl").substr(0, 80), HasSubstr("preview"));
  for (const char* name : {"a.stl", "a.ply", "a.vtp"}) {
    const TriMesh surface = read_surface(folder / name);
    EXPECT_EQ(flaws_of(check_surface(surface)), "") << name;
    EXPECT_TRUE(find_self_intersections(surface).empty()) << name;
  }
  const auto report = report_of(folder, "a");
  EXPECT_EQ(report["settings"]["preview"], true);
  EXPECT_EQ(report["surface"]["closed"], true);
  EXPECT_EQ(report["mesh"]["tets"], 0);
  EXPECT_EQ(report["iterations"].size(), 1U);
  EXPECT_FAILS(run_program(folder, segment_arguments(folder, "b", {"--preview"})), 2,
               "--preview: expected neither --mesh nor --band-mesh, found one");
}

TEST(SegmentCommand, ReadsARawFileAsAnyOther) {
  const TempFolder folder;
  write_ball(folder, 20);
  const std::string scan = read_bytes(folder / "ball.nrrd");
  const std::string samples = scan.substr(scan.find("\n\n") + 2);
  write_bytes(folder / "ball.raw", "head" + samples);
  const auto preview = [&folder](std::vector<std::string> input, const std::string& name) {
    input.insert(input.begin(), "segment");
    input.insert(input.end(), {"--preview", "--quiet", "-o", folder / name});
    const ProgramRun run = run_program(folder, input);
    EXPECT_EQ(run.status, 0) << run.err;
    return read_bytes(folder / name);
  };
  EXPECT_EQ(preview({folder / "ball.raw", "--raw", "20,20,20,float32,4", "--spacing", "1,1,1"},
                    "raw.stl"),
            preview({folder / "ball.nrrd"}, "nrrd.stl"));
  const std::string raw = folder / "ball.raw", out = folder / "a.stl";
  EXPECT_FAILS(run_program(folder, {"segment", raw, "-o", out, "--raw", "20,20,20,float32"}), 3,
               "expected 32000 bytes, 0 of header and 32000 of 20 x 20 x 20 samples, found 32004");
  EXPECT_FAILS(run_program(folder, {"segment", raw, "-o", out, "--raw", "20,20,float32"}), 2,
               "--raw: expected NX,NY,NZ,TYPE");
  EXPECT_FAILS(run_program(folder, {"segment", raw, "-o", out, "--spacing", "1,0,1"}), 2,
               "--spacing: expected numbers above 0");
}

TEST(SegmentCommand, GivesTheScansOwnValuesBeyondTheWindow) {
  const TempFolder folder;
  write_ball(folder, 20);  // 230 inside, 120 outside
  const ProgramRun run = run_program(
      folder, segment_arguments(folder, "a",
                                {"--window", "130,200", "--level", "175", "--mesh-region", "object",
                                 "--max-tets", "3000", "--quiet"}));
  EXPECT_THAT(run.status, testing::AnyOf(0, 4)) << run.err;
  const MeshWithArrays object = read_vtu(folder / "a.vtu");
  const auto& u = array_of(object.cell_arrays, "u");
  const auto& u_native = array_of(object.cell_arrays, "u_native");
  for (std::size_t c = 0; c < u.size(); ++c) EXPECT_NEAR(u_native[c], 130 + u[c] / 255 * 70, 1e-9);
  double weighted = 0, volume = 0;
  const Vec3 center{9.5, 9.5, 9.5};
  for (std::size_t c = 0; c < u.size(); ++c) {
    const auto p = cell_corners(object.mesh, object.mesh.cells[c]);
    if (norm(0.25 * (p[0] + p[1] + p[2] + p[3]) - center) > kRadius - 3) continue;
    const double v = cell_volume(object.mesh, static_cast<Index>(c));
    EXPECT_LT(u_native[c], 205) << "the window ends at 200";
    weighted += v * array_of(object.cell_arrays, "native")[c];
    volume += v;
  }
  EXPECT_NEAR(weighted / volume, 230, 1);
}

TEST(SegmentCommand, RefusesInOneLineAndWritesNothing) {
  const TempFolder folder;
  write_ball(folder, 18);
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
               "ends with one of .stl .ply .obj .vtp .3mf .amf .glb .dcm .obj.dcm, found");
  EXPECT_FAILS(outputs("a.stl", "a.foo"), 2, "ends with one of .vtu .mesh .msh .inp, found");
  for (const auto* bins : {"0", "1000", "-3", "2.5"}) {
    EXPECT_FAILS(run_program(folder, segment_arguments(folder, "a", {"--bins", bins})), 2,
                 "--bins");
  }
  EXPECT_FAILS(run_program(folder, segment_arguments(folder, "a", {"--error"})), 2,
               "--error: expected a .vtp or .ply among --output, found none");
  EXPECT_FAILS(run_program(folder, segment_arguments(folder, "a", {"--mesh-region", "ball"})), 2,
               "ball not in {box,object}");
  EXPECT_FAILS(run_program(folder, segment_arguments(folder, "a",
                                                     {"--mesh-region", "object", "--min-volume",
                                                      "1e9", "--quiet", "--max-tets", "1000"})),
               3, "mesh region: expected cells with u above the level");
  // Options that only change what another one makes are refused without it.
  const auto beside = [&folder](const std::vector<std::string>& options) {
    std::vector<std::string> words{"segment", folder / "ball.nrrd", "--report", folder / "r.json"};
    words.insert(words.end(), options.begin(), options.end());
    return run_program(folder, words);
  };
  EXPECT_FAILS(beside({"--bins", "3"}), 2, "--bins: expected --mesh beside it, found none");
  EXPECT_FAILS(beside({"--mesh-region", "box"}), 2, "--mesh-region: expected --mesh beside it");
  EXPECT_FAILS(beside({"--name", "hip"}), 2, "--name: expected --output beside it, found none");
  EXPECT_FAILS(beside({"--band-threshold", "0.1"}), 2,
               "--band-threshold: expected --surface band or --band-mesh beside it, found neither");
  EXPECT_FAILS(outputs("none/a.stl", "a.vtu"), 3, "there is no folder");
  for (const auto* option : {"--max-tets", "--adaptations", "--amis-iterations"}) {
    EXPECT_FAILS(run_program(folder, segment_arguments(folder, "a", {option, "300.5"})), 2,
                 "expected a whole number, found 300.5");
  }
  EXPECT_FAILS(run_program(folder, segment_arguments(folder, "a", {"--stride", "1,1,1,"})), 2,
               "--stride");
  EXPECT_FAILS(run_program(folder, segment_arguments(folder, "a", {"--memory", "0.01"})), 3,
               "memory: expected about 0.1 GB for this run, found 0.0 GB; no stride fits");
  EXPECT_FAILS(
      run_program(folder, segment_arguments(folder, "a", {"--min-volume", "1e9", "--quiet"})), 3,
      "surface: expected a part of at least --min-volume 1e+09 mm^3, found 1 of ");
  EXPECT_FAILS(
      run_program(folder, segment_arguments(folder, "a", {"--window", "900,990", "--quiet"})), 3,
      "window: expected a range that contains samples");
  write_bytes(folder / "ball.nrrd", "no scan");
  EXPECT_FAILS(run_program(folder, segment_arguments(folder, "a", {"--quiet"})), 3, "ball.nrrd");
  EXPECT_EQ(folder.file_count(), 4) << "the scan, the settings, stdout and stderr";
}

TEST(SegmentCommand, RefusesARunThatWouldWriteNothingBeforeItReads) {
  const TempFolder folder;
  const std::vector<std::string> nothing{"segment", folder / "no scan.nrrd"};
  EXPECT_FAILS(run_program(folder, nothing), 2,
               "expected --output, --mesh, --body, --band-mesh, --labelmap, --report, --html or");
  for (const auto* more : {"--preview", "--error", "--quiet"}) {
    auto arguments = nothing;
    arguments.emplace_back(more);
    EXPECT_FAILS(run_program(folder, arguments), 2, "found nothing to write");
  }
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

TEST(SegmentCommand, ATimeLimitLeavesTheBestResultSoFar) {
  const TempFolder folder;
  const std::string scan = folder / "scan.nrrd";
  ASSERT_EQ(run_program(folder, {"phantom", "sphere", "--size", "16,16,16", "-o", scan}).status, 0);
  const auto run = [&](const std::string& name, const std::vector<std::string>& more) {
    std::vector<std::string> words{
        "segment",    scan,   "-o",       folder / (name + ".stl"), "--quiet",
        "--max-tets", "2000", "--report", folder / (name + ".json")};
    words.insert(words.end(), more.begin(), more.end());
    return run_program(folder, words);
  };
  const ProgramRun stopped = run("a", {"--time-limit", "1e-6", "--mesh", folder / "a.vtu"});
  EXPECT_EQ(stopped.status, 4) << stopped.err;
  EXPECT_THAT(stopped.err, testing::HasSubstr("stopped by the time limit before the first mesh"));
  EXPECT_FALSE(std::filesystem::exists(folder / "a.vtu"));
  const auto report = nlohmann::json::parse(read_bytes(folder / "a.json"));
  EXPECT_EQ(report["stopped"], true);
  EXPECT_EQ(report["converged"], false);
  EXPECT_EQ(report["files"].size(), 1u);
  ASSERT_EQ(run("b", {"--preview"}).status, 0);
  EXPECT_EQ(read_bytes(folder / "a.stl"), read_bytes(folder / "b.stl"));
  ASSERT_EQ(run("c", {"--time-limit", "600"}).status, 0);
  EXPECT_EQ(nlohmann::json::parse(read_bytes(folder / "c.json"))["stopped"], false);
  EXPECT_FAILS(run("d", {"--time-limit", "0"}), 2, "--time-limit");
  EXPECT_FAILS(run("d", {"--time-limit", "9", "--labels", scan}), 2, "--time-limit");
}

}  // namespace
}  // namespace mesamis
