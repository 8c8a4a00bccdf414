// SPDX-License-Identifier: Apache-2.0
#include "mesamis/study/study_tables.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "mesamis/study/study_json.h"
#include "study/made_up_runs.h"
#include "support/temp_folder.h"
#include "support/throws.h"

namespace mesamis {
namespace {

using testing::Each;
using testing::Pair;

const PlannedRun kFull{"region_full", 1, {1, 1, 1}, true}, kSparse{"region_s2", 2, {2, 2, 2}};

std::vector<StudyRun> runs_of_a_region() {
  return with_distance_variations({made_up_run(kFull, 0.5), made_up_run(kSparse, 0.75)});
}

/// Where study.json has the figures of the columns of runs.csv.
const std::map<std::string, std::string> kPlaces{
    {"run", "/name"},
    {"s", "/s"},
    {"slices", "/size/2"},
    {"spacing_z_mm", "/spacing_mm/2"},
    {"tets", "/mesh/tets"},
    {"nodes", "/mesh/nodes"},
    {"triangles_extracted", "/surface/triangles_extracted"},
    {"triangles", "/surface/triangles"},
    {"triangle_reduction_percent", "/compared/triangle_reduction_percent"},
    {"energy_mm3", "/energy_mm3"},
    {"aspect_max", "/aspect_max"},
    {"aspect_mean", "/aspect_mean"},
    {"adaptations", "/adaptations"},
    {"converged", "/converged"},
    {"seconds", "/seconds"},
    {"reference_to_surface_mean_mm", "/distances/reference_to_surface/mean"},
    {"reference_to_surface_area_mean_mm", "/distances/reference_to_surface/by_area/mean"},
    {"surface_to_reference_mean_mm", "/distances/surface_to_reference/mean"},
    {"surface_to_reference_area_mean_mm", "/distances/surface_to_reference/by_area/mean"},
    {"hausdorff_mm", "/distances/paper/hausdorff"},
    {"distance_variation_percent", "/compared/distance_variation_percent"}};

TEST(RunsCsv, SaysWhatStudyJsonSays) {
  const std::vector<StudyRun> runs = runs_of_a_region();
  const auto row = csv_rows(runs_csv(runs)).at(1);
  const auto json = run_json({}, runs[1]);
  EXPECT_EQ(row.size(), kPlaces.size());
  for (const auto& [column, place] : kPlaces) {
    const nlohmann::ordered_json::json_pointer pointer(place);
    ASSERT_TRUE(json.contains(pointer)) << place;
    const auto& value = json[pointer];
    EXPECT_EQ(row.at(column), value.is_string() ? value.get<std::string>() : value.dump());
  }
}

TEST(RunsCsv, HasARowPerRunAndEmptyCellsWithoutAFigure) {
  const StudyRun failed = failed_run({"s4", 4, {1, 1, 4}}, "why");
  const auto rows = csv_rows(runs_csv(std::vector{made_up_run(kFull, 0.5), failed}));
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_EQ(rows[0].at("distance_variation_percent"), "");
  EXPECT_NE(rows[0].at("hausdorff_mm"), "");
  auto row = rows[1];
  EXPECT_EQ(row.at("run"), "s4");
  EXPECT_EQ(row.at("s"), "4");
  EXPECT_EQ(row.at("converged"), "false");
  for (const auto* column : {"run", "s", "converged"}) row.erase(column);
  EXPECT_THAT(row, Each(Pair(testing::_, "")));
}

TEST(RunsCsv, ABandIsNotDecimated) {
  StudyRun run = made_up_run(kSparse, 0.5);
  run.summary->parameters.surface = SurfaceKind::kBand;
  EXPECT_EQ(csv_rows(runs_csv(std::vector{run})).at(0).at("triangles_extracted"), "");
}

TEST(RunsCsv, OfNoRunsHasTheNamesAlone) {
  EXPECT_TRUE(csv_rows(runs_csv({})).empty());
  EXPECT_THAT(runs_csv({}), testing::StartsWith("run,s,slices,"));
}

TEST(ConvergenceCsv, HasARowPerIteration) {
  const StudyRun failed = failed_run({"s4", 4, {1, 1, 4}}, "why");
  const auto rows = csv_rows(convergence_csv(std::vector{failed, made_up_run(kSparse, 0.5)}));
  ASSERT_EQ(rows.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(rows[i].at("run"), "region_s2");
    EXPECT_EQ(rows[i].at("s"), "2");
    EXPECT_EQ(rows[i].at("iteration"), std::to_string(i + 1));
    EXPECT_EQ(std::stod(rows[i].at("tets")), 1000 * (static_cast<double>(i) + 1));
    EXPECT_EQ(std::stod(rows[i].at("energy")), 8 - 2 * static_cast<double>(i));
  }
}

TEST(ConvergenceCsv, WhatAPassHasNotMeasuredIsEmpty) {
  const auto rows = csv_rows(convergence_csv(std::vector{made_up_run(kSparse, 0.5)}));
  const auto column = [&rows](const char* name) {
    return std::vector{rows[0].at(name), rows[1].at(name), rows[2].at(name)};
  };
  EXPECT_THAT(column("energy_change"), testing::ElementsAre("", "0.25", "0.25"));
  EXPECT_THAT(column("mesh_change"), testing::ElementsAre("", "0.25", ""));
  EXPECT_THAT(column("estimator"), testing::ElementsAre("0.25", "0.25", ""));
}

TEST(HistogramCsv, CountsEveryDistanceOfTheRunsThatHaveSome) {
  const StudyRun failed = failed_run({"s4", 4, {1, 1, 4}}, "why");
  const auto rows = csv_rows(histogram_csv(std::vector{made_up_run(kSparse, 0.5), failed}));
  double vertices = 0, area = 0;
  for (const auto& row : rows) {
    EXPECT_EQ(row.count("s4_vertices"), 0u);
    vertices += std::stod(row.at("region_s2_vertices"));
    area += std::stod(row.at("region_s2_area"));
  }
  EXPECT_EQ(vertices, 2);
  EXPECT_EQ(area, 3);
}

TEST(WriteTables, PutsThreeFilesIntoTheFolder) {
  const TempFolder folder;
  const std::vector<StudyRun> runs = runs_of_a_region();
  write_tables(folder.path(), "region_", runs);
  EXPECT_EQ(read_bytes(folder / "region_runs.csv"), runs_csv(runs));
  EXPECT_EQ(read_bytes(folder / "region_convergence.csv"), convergence_csv(runs));
  EXPECT_EQ(read_bytes(folder / "region_histogram.csv"), histogram_csv(runs));
  EXPECT_EQ(folder.file_count(), 3);
  EXPECT_REFUSED(write_tables(folder / "none", "", runs), testing::HasSubstr("none"));
}

}  // namespace
}  // namespace mesamis
