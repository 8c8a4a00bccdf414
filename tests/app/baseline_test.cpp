// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "mesamis/baseline/geodesic_contour.h"
#include "mesamis/phantom/degrade.h"
#include "mesamis/phantom/phantom.h"
#include "mesamis/restore/half_maximum_level.h"
#include "mesamis/shape_files/surface_files.h"
#include "mesamis/volume_files/read_volume.h"
#include "mesamis/volume_files/write_volume.h"
#include "support/run_program.h"

namespace mesamis {
namespace {

using nlohmann::json;
using testing::ElementsAre;
using testing::HasSubstr;

#define MESAMIS_REQUIRE_ITK() \
  if (!has_geodesic_contour()) GTEST_SKIP() << "the program was built without ITK"

std::string scan_in(const TempFolder& folder) {
  const Volume volume = sample_phantom(make_phantom("sphere", {32, 32, 32}));
  write_nrrd(folder / "scan.nrrd", degrade(volume, {.blur = 0.8, .noise = 8}));
  return folder / "scan.nrrd";
}

ProgramRun baseline(const TempFolder& folder, std::vector<std::string> options) {
  options.insert(options.begin(), {"baseline", scan_in(folder), "--quiet"});
  return run_program(folder, options);
}

json report_in(const TempFolder& folder) { return json::parse(read_bytes(folder / "r.json")); }

TEST(BaselineCommand, SmoothingBeyondAllVoxelsIsRefusedAtOnce) {
  const TempFolder folder;
  for (const char* sigma : {"inf", "7e8", "-1", "nan", "100.5"}) {
    for (const char* method : {"isosurface", "geodesic"}) {
      if (method[0] == 'g' && !has_geodesic_contour()) continue;
      EXPECT_FAILS(run_program(folder, {"baseline", "none.nrrd", "-o", folder / "a.stl", "--method",
                                        method, "--smooth", sigma}),
                   2, "smooth");
    }
  }
}

TEST(BaselineCommand, MakesAnIsosurface) {
  const TempFolder folder;
  const ProgramRun run = baseline(folder, {"-o", folder / "a.ply", "--smooth", "1", "--triangles",
                                           "500", "--report", folder / "r.json"});
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_LE(read_surface(folder / "a.ply").triangles.size(), 510u);
  const json report = report_in(folder);
  EXPECT_EQ(report["settings"]["method"], "isosurface");
  EXPECT_EQ(report["settings"]["smooth"], 1);
  EXPECT_NEAR(report["settings"]["level"], 175, 5);
  EXPECT_EQ(report["converged"], true);
  EXPECT_FALSE(report.contains("contour"));
}

TEST(BaselineCommand, MeasuresTheLevelInTheScanUnlessGiven) {
  const TempFolder folder;
  const auto level = [&folder](const std::vector<std::string>& more) {
    std::vector<std::string> options{"-o", folder / "a.stl", "--report", folder / "r.json"};
    options.insert(options.end(), more.begin(), more.end());
    EXPECT_EQ(baseline(folder, options).status, 0);
    return report_in(folder)["settings"]["level"].get<double>();
  };
  const double measured = level({});
  EXPECT_EQ(measured, find_half_maximum_level(read_volume(folder / "scan.nrrd").volume).level);
  EXPECT_EQ(level({"--smooth", "1"}), measured) << "of the scan as it is";
  EXPECT_EQ(level({"--level", "150"}), 150);
}

TEST(BaselineCommand, SaysWhereItCannotHaveSoManyTriangles) {
  const TempFolder folder;
  const std::string scan = scan_in(folder);
  const auto warning = [&](const char* triangles) {
    const ProgramRun run =
        run_program(folder, {"baseline", scan, "-o", folder / "a.ply", "--triangles", triangles});
    EXPECT_EQ(run.status, 0);
    return run.err;
  };
  EXPECT_THAT(warning("1000000"), HasSubstr("--triangles: expected about 1000000, found "));
  EXPECT_THAT(warning("1000000"), HasSubstr("the surface has no more"));
  EXPECT_THAT(warning("500"), testing::Not(HasSubstr("--triangles")));
}

TEST(BaselineCommand, MakesAGeodesicContourAndTellsHow) {
  MESAMIS_REQUIRE_ITK();
  const TempFolder folder;
  const ProgramRun run = baseline(folder, {"--method", "geodesic", "-o", folder / "a.ply",
                                           "--triangles", "500", "--report", folder / "r.json"});
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(run.err, "");
  EXPECT_LE(read_surface(folder / "a.ply").triangles.size(), 510u);
  const json report = report_in(folder);
  EXPECT_EQ(report["converged"], true);
  EXPECT_EQ(report["settings"]["smooth"], 0.5);
  EXPECT_LT(report["settings"]["alpha"], 0);
  EXPECT_THAT(report["chosen"], ElementsAre("level", "alpha", "beta"));
  EXPECT_EQ(report["surface"]["closed"], true);
  EXPECT_EQ(report["surface"]["components"], 1);
  EXPECT_LE(report["contour"]["iterations"], report["settings"]["iterations"]);
  EXPECT_LT(report["contour"]["rms_change"], report["settings"]["rms_change"]);
  EXPECT_GT(report["contour"]["edge_gradient"], report["settings"]["beta"]);
  EXPECT_LE(report["seconds_parts"]["method"], report["seconds"]);
  EXPECT_GT(report["peak_memory_mb"], 0);
}

TEST(BaselineCommand, GivesTheSameBytesForAnyNumberOfThreads) {
  MESAMIS_REQUIRE_ITK();
  const TempFolder folder;
  for (const char* threads : {"1", "2"}) {
    const ProgramRun run =
        baseline(folder, {"--method", "geodesic", "--diffusions", "2", "-o",
                          folder / (std::string(threads) + ".stl"), "--threads", threads});
    EXPECT_EQ(run.status, 0) << run.err;
  }
  EXPECT_EQ(read_bytes(folder / "1.stl"), read_bytes(folder / "2.stl"));
}

TEST(BaselineCommand, WritesAndMarksWhatDidNotComeToRest) {
  MESAMIS_REQUIRE_ITK();
  const TempFolder folder;
  const ProgramRun run =
      baseline(folder, {"--method", "geodesic", "--shrink", "2", "--iterations", "7", "-o",
                        folder / "a.ply", "--report", folder / "r.json"});
  EXPECT_EQ(run.status, 4);
  EXPECT_EQ(run.error_lines(), 1u);
  EXPECT_THAT(run.err, HasSubstr("not converged: after 7 iterations"));
  EXPECT_FALSE(read_surface(folder / "a.ply").triangles.empty());
  const json report = report_in(folder);
  EXPECT_EQ(report["converged"], false);
  EXPECT_EQ(report["contour"]["iterations"], 7);
}

TEST(BaselineCommand, RefusesInOneLineAndWritesNothing) {
  const TempFolder folder;
  const std::string out = folder / "a.ply";
  EXPECT_FAILS(baseline(folder, {"-o", out, "--method", "snake"}), 2, "--method");
  EXPECT_FAILS(baseline(folder, {"-o", out, "--sigma", "1"}), 2,
               "--sigma is for --method geodesic");
  EXPECT_FAILS(baseline(folder, {"-o", out, "--report", folder / "r.txt"}), 2, "--report");
  EXPECT_FAILS(baseline(folder, {"-o", out, "--level", "1e6"}), 3, "nothing crosses");
  if (has_geodesic_contour()) {
    EXPECT_FAILS(baseline(folder, {"-o", out, "--method", "geodesic", "--iterations", "0"}), 2,
                 "iterations: expected 1 or more, found 0");
    EXPECT_FAILS(baseline(folder, {"-o", out, "--method", "geodesic", "--alpha=3"}), 2, "alpha");
    EXPECT_FAILS(baseline(folder, {"-o", out, "--method", "geodesic", "--level", "1e6"}), 3,
                 "both sides of the level");
  } else {
    EXPECT_FAILS(baseline(folder, {"-o", out, "--method", "geodesic"}), 2, "without ITK");
  }
  EXPECT_FALSE(std::filesystem::exists(out));
}

}  // namespace
}  // namespace mesamis
