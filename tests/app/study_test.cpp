// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "mesamis/shape_files/surface_files.h"
#include "support/run_program.h"
#include "support/variable.h"

namespace mesamis {
namespace {

using nlohmann::json;
using testing::HasSubstr;

namespace fs = std::filesystem;

constexpr double kVoxel = 2.4;  // mm

constexpr int kSize = 24;

/// A ball of radius 18 mm in 24 x 24 x 24 voxels of 2.4 mm: scan.nrrd, and truth.ply around its
/// middle, (28.8, 28.8, 28.8).
void make_ball(const TempFolder& folder) {
  const ProgramRun run = run_program(
      folder, {"phantom", "sphere", "-o", folder / "scan.nrrd", "--truth", folder / "truth.ply",
               "--size", "24,24,24", "--spacing", "2.4,2.4,2.4", "--noise", "2", "--quiet"});
  ASSERT_EQ(run.status, 0) << run.err;
}

ProgramRun study(const TempFolder& folder, const std::vector<std::string>& more,
                 const std::string& reference = "truth.ply") {
  std::vector<std::string> arguments{
      "study",        folder / "scan.nrrd", "--reference", folder / reference, "-o",
      folder / "out", "--max-tets",         "4000",        "--quiet"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return run_program(folder, arguments);
}

json report_of(const TempFolder& folder) {
  return json::parse(read_bytes(folder / "out/study.json"));
}

/// The rows of a table, each a map from the names of the columns.
std::vector<std::map<std::string, std::string>> read_csv(const std::string& path) {
  std::istringstream text(read_bytes(path));
  std::string line, cell;
  std::vector<std::string> names;
  std::vector<std::map<std::string, std::string>> rows;
  while (std::getline(text, line)) {
    std::istringstream cells(line + ",");
    std::vector<std::string> row;
    while (std::getline(cells, cell, ',')) row.push_back(cell);
    if (names.empty()) {
      names = row;
      continue;
    }
    EXPECT_EQ(row.size(), names.size()) << line;
    auto& entry = rows.emplace_back();
    for (std::size_t i = 0; i < row.size(); ++i) entry[names[i]] = row[i];
  }
  return rows;
}

double number(const json& run, const char* place) {
  return run[json::json_pointer(place)].get<double>();
}

TEST(StudyCommand, TablesSayWhatCompareSaysOfTheSurfacesLeftBehind) {
  const TempFolder folder;
  make_ball(folder);
  const ProgramRun run = study(folder, {"--subsample", "1,2", "--adaptations", "6"});
  EXPECT_THAT(run.status, testing::AnyOf(0, 4)) << run.err;
  const json runs = report_of(folder)["subsampling"]["runs"];
  const auto rows = read_csv(folder / "out/runs.csv");
  const auto histogram = read_csv(folder / "out/histogram.csv");
  ASSERT_EQ(runs.size(), 2u);
  ASSERT_EQ(rows.size(), 2u);
  for (const int s : {1, 2}) {
    const json& found = runs[static_cast<std::size_t>(s - 1)];
    auto row = rows[static_cast<std::size_t>(s - 1)];
    const std::string name = "s" + std::to_string(s);
    EXPECT_EQ(found["name"], name);
    EXPECT_EQ(row["run"], name);
    EXPECT_EQ(found["size"], json({kSize, kSize, kSize / s}));
    EXPECT_EQ(row["slices"], std::to_string(kSize / s));
    EXPECT_EQ(found["spacing_mm"], json({kVoxel, kVoxel, s * kVoxel}));
    EXPECT_EQ(std::stod(row["tets"]), number(found, "/mesh/tets"));
    EXPECT_EQ(std::stod(row["triangles"]), number(found, "/surface/triangles"));
    EXPECT_EQ(row["converged"] == "true", found["converged"].get<bool>());

    const std::string report = folder / (name + ".json");
    run_program(folder, {"compare", folder / "truth.ply", folder / ("out/" + name + ".ply"),
                         "--report", report});
    const json compared = json::parse(read_bytes(report));
    for (const auto* direction : {"surface_to_reference", "reference_to_surface", "paper"}) {
      EXPECT_EQ(found["distances"][direction], compared[direction]) << direction;
    }
    const double mean = compared["reference_to_surface"]["mean"];
    EXPECT_EQ(std::stod(row["reference_to_surface_mean_mm"]), mean);
    EXPECT_LT(mean, (s == 1 ? 0.15 : 0.4) * kVoxel) << "near the truth";
    double vertices = 0;
    for (auto bin : histogram) vertices += std::stod(bin[name + "_vertices"]);
    EXPECT_EQ(vertices, number(compared, "/reference_to_surface/vertices"));
  }
}

TEST(StudyCommand, NamesFilesOfAnEarlierStudyAndLeavesThem) {
  const TempFolder folder;
  make_ball(folder);
  study(folder, {"--subsample", "4", "--preview"});
  write_bytes(folder / "out/mine.csv", "1,2");
  const ProgramRun again =
      run_program(folder, {"study", folder / "scan.nrrd", "--reference", folder / "truth.ply", "-o",
                           folder / "out", "--subsample", "2", "--preview"});
  EXPECT_THAT(again.err, HasSubstr("not of this study: mine.csv, s4.ply\n"));
  EXPECT_EQ(read_bytes(folder / "out/mine.csv"), "1,2");
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "out/s4.ply"));
}

TEST(StudyCommand, MarksWhatHasNotConvergedAndWritesAllTheSame) {
  const TempFolder folder;
  make_ball(folder);
  const ProgramRun run =
      study(folder, {"--subsample", "2", "--adaptations", "2", "--until", "energy", "--tol-energy",
                     "0", "--tol-mesh", "0", "--gamma", "0.2"});
  EXPECT_EQ(run.status, 4);
  EXPECT_EQ(run.error_lines(), 1u) << run.err;
  EXPECT_THAT(run.err, HasSubstr("s2: not converged"));
  EXPECT_THAT(run.out, HasSubstr("s2"));
  const json report = report_of(folder);
  EXPECT_EQ(report["converged"], false);
  EXPECT_EQ(report["settings"]["gamma"], 0.2) << "the settings of segment";
  const json& found = report["subsampling"]["runs"][0];
  EXPECT_EQ(found["converged"], false);
  EXPECT_THAT(found["remark"], HasSubstr("not converged"));
  EXPECT_EQ(found["settings"]["gamma"], 0.2);
  const auto rows = read_csv(folder / "out/convergence.csv");
  ASSERT_EQ(rows.size(), found["iterations"].size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    EXPECT_EQ(std::stod(rows[i].at("energy")), found["iterations"][i]["energy"].get<double>());
    EXPECT_EQ(std::stod(rows[i].at("tets")), found["iterations"][i]["tets"].get<double>());
    EXPECT_EQ(rows[i].at("iteration"), std::to_string(i + 1));
  }
  std::set<std::string> files;
  for (const auto& entry : fs::directory_iterator(folder / "out")) {
    files.insert(entry.path().filename());
  }
  EXPECT_EQ(files, (std::set<std::string>{"study.json", "runs.csv", "convergence.csv",
                                          "histogram.csv", "s2.ply", "distance.svg",
                                          "histogram.svg", "energy.svg", "cells.svg"}));
}

TEST(StudyCommand, MeasuresARegionAwayFromWhereItIsCut) {
  const TempFolder folder;
  make_ball(folder);
  // The quarter of the ball at one of its sides: three faces cut it.
  const ProgramRun run = study(folder, {"--region", "9:,3:21,12:", "--region-subsample", "2",
                                        "--adaptations", "2", "--tolerance", "0"});
  EXPECT_THAT(run.status, testing::AnyOf(0, 4)) << run.err;
  const json report = report_of(folder);
  EXPECT_FALSE(report.contains("subsampling"));
  const json& runs = report["region"]["runs"];
  ASSERT_EQ(runs.size(), 2u);
  const auto rows = read_csv(folder / "out/region_runs.csv");
  const double full = number(runs[0], "/distances/paper/average_hausdorff");
  EXPECT_EQ(runs[0]["name"], "region_full");
  EXPECT_EQ(runs[0]["size"], json({15, 18, 12}));
  EXPECT_EQ(runs[1]["name"], "region_s2");
  EXPECT_EQ(runs[1]["size"], json({8, 9, 6}));
  EXPECT_EQ(runs[1]["spacing_mm"], json({2 * kVoxel, 2 * kVoxel, 2 * kVoxel}));
  for (std::size_t i = 0; i < 2; ++i) {
    const double voxel = (i == 0 ? 1 : 2) * kVoxel;
    // The caps on the cut faces lie up to 18 mm from the truth.
    EXPECT_LT(number(runs[i], "/distances/surface_to_reference/by_area/max"), 1.5 * voxel) << i;
    EXPECT_LT(number(runs[i], "/distances/reference_to_surface/by_area/max"), 1.5 * voxel) << i;
    EXPECT_LT(number(runs[i], "/compared/triangles"), number(runs[i], "/surface/triangles"));
    const double share =
        number(runs[i], "/compared/triangles") / number(runs[i], "/compared/reference_triangles");
    EXPECT_NEAR(number(runs[i], "/compared/triangle_reduction_percent"), 100 * (1 - share), 1e-9);
    EXPECT_EQ(rows[i].at("distance_variation_percent").empty(), i == 0);
    if (i == 0) continue;
    const double own = number(runs[i], "/distances/paper/average_hausdorff");
    EXPECT_NEAR(std::stod(rows[i].at("distance_variation_percent")), 100 * (own / full - 1), 1e-9);
  }
  // A quarter of a sphere, but for the margin.
  const TriMesh surface = read_surface(folder / "out/region_full.ply");
  for (const Vec3& p : surface.points) {
    EXPECT_GT(p.x, 22.79) << "voxel 9 is at 22.8 mm";
    EXPECT_GT(p.z, 29.99);
  }
}

TEST(StudyCommand, GoesOnWhereOneRunFails) {
  const TempFolder folder;
  make_ball(folder);
  // Both slices that s = 23 leaves are outside the ball, below the level.
  const ProgramRun run = study(folder, {"--subsample", "2,23", "--adaptations", "1", "--window",
                                        "150,240", "--level", "190"});
  EXPECT_EQ(run.status, 4) << run.err;
  EXPECT_THAT(run.err, HasSubstr("s23: level: expected a value between the least"));
  const json runs = report_of(folder)["subsampling"]["runs"];
  EXPECT_FALSE(runs[0].contains("failed"));
  EXPECT_THAT(runs[1]["failed"], HasSubstr("found 190"));
  const auto rows = read_csv(folder / "out/runs.csv");
  EXPECT_NE(rows[0].at("reference_to_surface_mean_mm"), "");
  EXPECT_EQ(rows[1].at("reference_to_surface_mean_mm"), "");
  EXPECT_FALSE(fs::exists(folder / "out/s23.ply"));
}

TEST(StudyCommand, DrawsDiagramsWithoutADisplay) {
  const TempFolder folder;
  make_ball(folder);
  const Variable path("PATH", "/nowhere"), display("DISPLAY", ":987");
  const ProgramRun run = study(folder, {"--subsample", "4", "--adaptations", "1"});
  EXPECT_THAT(run.status, testing::AnyOf(0, 4)) << run.err;
  const json pictures = report_of(folder)["pictures"];
  EXPECT_EQ(pictures, json({"distance.svg", "histogram.svg", "energy.svg", "cells.svg"}));
  for (const auto& name : pictures) {
    EXPECT_THAT(read_bytes(folder / ("out/" + name.get<std::string>())),
                HasSubstr("class=\"series\""))
        << name;
  }
}

TEST(StudyCommand, RefusesPlainlyBeforeItBegins) {
  const TempFolder folder;
  make_ball(folder);
  EXPECT_FAILS(study(folder, {}), 2, "--subsample, --region");
  EXPECT_FAILS(study(folder, {"--subsample", "1", "--region-subsample", "1"}), 2,
               "--region-subsample: expected --region beside it");
  for (const auto* steps : {"0", "1,-2", "2,2", "1.5", "1,", "many"}) {
    EXPECT_FAILS(study(folder, {"--subsample", steps}), 2, "--subsample");
  }
  EXPECT_FAILS(study(folder, {"--subsample", "1,24"}), 3,
               "s24: subsample: expected at least 2 voxels to remain along axis 2, found 1");
  EXPECT_FAILS(study(folder, {"--region", "0:10,0:10"}), 2, "--region");
  EXPECT_FAILS(study(folder, {"--region", "0:40,0:10,0:10"}), 3, "found 0:40");
  EXPECT_FAILS(study(folder, {"--region", "0:3,0:3,0:3"}), 3, "region_s4");
  EXPECT_FAILS(study(folder, {"--region", "0:8,0:8,0:8"}), 3, "triangles inside the region");
  EXPECT_FAILS(study(folder, {"--subsample", "1", "--gamma", "-1"}), 2, "gamma");
  EXPECT_FAILS(study(folder, {"--subsample", "1", "--level", "180", "--window", "0,170"}), 3,
               "s1: level");
  EXPECT_FAILS(study(folder, {"--subsample", "4", "--level", "500", "--adaptations", "1"}), 3,
               "s4: level: expected a value between the least and the greatest of the data");
  EXPECT_FAILS(study(folder, {"--subsample", "4", "--min-volume", "1e9", "--adaptations", "1"}), 3,
               "s4: there is no surface");
  EXPECT_FAILS(study(folder, {"--subsample", "1"}, "none.ply"), 3, "none.ply");
  EXPECT_FAILS(study(folder, {"--subsample", "1"}, "scan.nrrd"), 3, "scan.nrrd");
  EXPECT_FALSE(fs::exists(folder / "out"));
  EXPECT_FAILS(
      run_program(folder, {"study", folder / "scan.nrrd", "--reference", folder / "truth.ply",
                           "--subsample", "1", "-o", folder / "none/out"}),
      3, "none/out: expected a folder");
  write_bytes(folder / "out", "a file");
  EXPECT_FAILS(study(folder, {"--subsample", "1"}), 3, "expected a folder");
}

TEST(StudyCommand, HeedsTheReferencesFrame) {
  const TempFolder folder;
  make_ball(folder);
  const TriMesh truth = read_surface(folder / "truth.ply");
  write_surface(folder / "ras.ply", truth, {.frame = Frame::kRas});
  write_surface(folder / "silent.ply", turned(truth), {.frame = {}});
  const std::vector<std::string> fast{"--subsample", "4", "--adaptations", "1"};
  EXPECT_FAILS(study(folder, fast, "silent.ply"), 3, "triangles inside the scan");
  EXPECT_FALSE(fs::exists(folder / "out"));
  const auto mean = [&](std::vector<std::string> more, const std::string& reference) {
    more.insert(more.end(), fast.begin(), fast.end());
    const ProgramRun run = study(folder, more, reference);
    EXPECT_THAT(run.status, testing::AnyOf(0, 4)) << run.err;
    return number(report_of(folder)["subsampling"]["runs"][0],
                  "/distances/reference_to_surface/mean");
  };
  const double known = mean({}, "truth.ply");
  EXPECT_NEAR(mean({}, "ras.ply"), known, 1e-9);
  EXPECT_NEAR(mean({"--frames", "turned"}, "silent.ply"), known, 1e-9);
}

}  // namespace
}  // namespace mesamis
