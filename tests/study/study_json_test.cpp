// SPDX-License-Identifier: Apache-2.0
#include "mesamis/study/study_json.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "study/made_up_runs.h"

namespace mesamis {
namespace {

using nlohmann::json;

const PlannedRun kRun{"s2", 2, {1, 1, 2}};

TEST(StudyRunJson, HoldsPlanFiguresAndDistances) {
  StudyRun run = made_up_run(kRun, 0.5);
  run.surface_file = "s2.ply";
  const auto entry = run_json({}, run);
  EXPECT_EQ(entry["name"], "s2");
  EXPECT_EQ(entry["stride"], (json{1, 1, 2}));
  EXPECT_EQ(entry["size"], (json{20, 21, 22}));
  EXPECT_EQ(entry["surface_file"], "s2.ply");
  EXPECT_EQ(entry["energy_mm3"], 4 * 8) << "the last energy, 4, in units of 2 mm cubed";
  EXPECT_EQ(entry["adaptations"], 2);
  EXPECT_EQ(entry["iterations"].size(), 3u);
  EXPECT_EQ(entry["converged"], true);
  EXPECT_EQ(entry["remark"], "");
  EXPECT_FALSE(entry.contains("failed"));
  EXPECT_EQ(entry["compared"]["triangle_reduction_percent"], 25);
  EXPECT_FALSE(entry["compared"].contains("distance_variation_percent"));
  for (const char* direction : {"surface_to_reference", "reference_to_surface"}) {
    EXPECT_EQ(entry["distances"][direction]["mean"], 0.5) << direction;
    EXPECT_EQ(entry["distances"][direction]["by_area"]["samples"], 3) << direction;
  }
  EXPECT_EQ(entry["distances"]["paper"]["average_hausdorff"], 0.5);
}

TEST(StudyRunJson, MarksAFailedRun) {
  const auto entry = run_json({}, failed_run(kRun, "why"));
  EXPECT_EQ(entry["failed"], "why");
  EXPECT_EQ(entry["remark"], "why");
  EXPECT_EQ(entry["converged"], false);
  for (const char* missing : {"size", "iterations", "surface_file", "compared", "distances"}) {
    EXPECT_FALSE(entry.contains(missing)) << missing;
  }
}

TEST(StudyRunJson, ARunThatConvergedButCouldNotBeComparedIsNotConverged) {
  StudyRun run = made_up_run(kRun, 0.5);
  run.comparison.reset();
  run.failure = run.remark = "nothing inside";
  const auto entry = run_json({}, run);
  EXPECT_EQ(entry["converged"], false);
  EXPECT_EQ(entry["failed"], "nothing inside");
  EXPECT_TRUE(entry.contains("iterations"));
}

StudyRecord record_of(std::vector<StudyRun> runs) {
  StudyRecord study;
  study.reference = "truth.ply";
  study.reference_triangles = 12;
  study.pictures = {"cells.svg"};
  study.experiments.push_back({"subsampling", {}, std::move(runs)});
  return study;
}

TEST(StudyJson, HasAnEntryPerExperiment) {
  StudyRecord study = record_of({made_up_run(kRun, 0.5)});
  auto report = study_json(study);
  EXPECT_EQ(report["subsampling"]["runs"].size(), 1u);
  EXPECT_FALSE(report.contains("region"));
  EXPECT_EQ(report["reference"]["path"], "truth.ply");
  EXPECT_EQ(report["reference"]["triangles"], 12);
  EXPECT_EQ(report["pictures"], json{"cells.svg"});
  EXPECT_EQ(report["converged"], true);
  EXPECT_TRUE(report["frames"].is_null());
  study.frames.emplace();
  study.frames->surface_frame = Frame::kLps;
  EXPECT_EQ(study_json(study)["frames"]["surface"], "LPS");
}

TEST(StudyRecord, ItsOutcomeIsTheWorstOfItsRuns) {
  StudyRun open = made_up_run(kRun, 0.5);
  open.outcome = VerdictKind::kNotClosed;
  EXPECT_EQ(record_of({made_up_run(kRun, 0.5)}).outcome(), VerdictKind::kKept);
  EXPECT_EQ(record_of({open, failed_run(kRun, "why")}).outcome(), VerdictKind::kNotClosed);
  const StudyRecord failed = record_of({made_up_run(kRun, 0.5), failed_run(kRun, "why")});
  EXPECT_EQ(failed.outcome(), VerdictKind::kNotConverged);
  EXPECT_EQ(study_json(failed)["converged"], false);
}

}  // namespace
}  // namespace mesamis
