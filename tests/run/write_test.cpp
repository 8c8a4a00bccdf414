// SPDX-License-Identifier: Apache-2.0
#include "mesamis/run/write.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "mesamis/report/json_file.h"
#include "mesamis/run/run_files.h"
#include "mesamis/shape_files/surface_files.h"
#include "run/small_request.h"
#include "support/temp_folder.h"
#include "support/throws.h"

namespace mesamis {
namespace {

namespace fs = std::filesystem;
using testing::UnorderedElementsAre;

std::vector<std::string> names_in(const fs::path& folder) {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder)) {
    names.push_back(entry.path().filename().string());
  }
  return names;
}

TEST(WriteOutcome, WritesEveryFileOfOneObject) {
  const TempFolder folder;
  Outputs out;
  out.surfaces = {folder / "a.stl", folder / "a.vtp"};
  out.meshes = {folder / "a.vtu"};
  out.band_meshes = {folder / "band.vtu"};
  out.labelmap = folder / "a.nrrd";
  out.report = folder / "a.json";
  out.page.html = folder / "a.html";
  write(ball_outcome(), out);
  EXPECT_THAT(names_in(folder.path()), UnorderedElementsAre("a.stl", "a.vtp", "a.vtu", "band.vtu",
                                                            "a.nrrd", "a.html", "a.json"));
  EXPECT_EQ(read_surface_file(folder / "a.stl").surface.triangles.size(),
            ball_outcome().details().one->surface.triangles.size());
  const auto report = read_json(folder / "a.json");
  EXPECT_EQ(report["files"].size(), 6U) << "all but itself";
  EXPECT_EQ(report["surface"]["closed"], true);
  EXPECT_EQ(report["mesh"]["region"]["name"], "box");
  EXPECT_FALSE(report.contains("input")) << "no facts were given";
}

TEST(WriteOutcome, WritesAFilePerObject) {
  const TempFolder folder;
  Outputs out;
  out.surfaces = {folder / "{label}.stl", folder / "all.3mf"};
  out.meshes = {folder / "a.vtu"};
  write(halves_outcome(), out);
  EXPECT_THAT(names_in(folder.path()),
              UnorderedElementsAre("left.stl", "right.stl", "all.3mf", "a.vtu"));
}

TEST(WriteOutcome, AReportMayBeCompletedAndSeen) {
  RunFiles out;
  out.facts.complete = [](nlohmann::ordered_json& report) { report["seconds"] = 7; };
  nlohmann::ordered_json seen;
  out.facts.written = [&](const nlohmann::ordered_json& report, OutputSet&) { seen = report; };
  out.facts.command = {"segment", "a"};
  out.facts.warnings = {"a warning of a label file"};
  write(ball_outcome().details(), out);
  EXPECT_EQ(seen["seconds"], 7);
  EXPECT_EQ(seen["command"][1], "a");
  EXPECT_EQ(seen["warnings"][0], "a warning of a label file");
}

/// One that cannot be written takes the others with it.
TEST(WriteOutcome, LeavesNothingWhereAFileIsRefused) {
  const TempFolder folder;
  Outputs out;
  out.surfaces = {folder / "a.stl", folder / "missing" / "b.stl"};
  EXPECT_THROW(write(ball_outcome(), out), InputError);
  EXPECT_THAT(names_in(folder.path()), testing::IsEmpty());
}

TEST(WriteOutcome, RefusesASurfaceThatWasNotFound) {
  const TempFolder folder;
  Request request = ball_request();
  request.settings.preview = true;
  request.settings.min_volume = 1e6;
  const Outcome found = segment(std::move(request));
  Outputs out;
  out.report = folder / "a.json";
  EXPECT_NO_THROW(write(found, out)) << "the report says that there is none";
  out.surfaces = {folder / "a.stl"};
  EXPECT_REFUSED(
      write(found, out),
      testing::HasSubstr("expected a part of at least --min-volume 1e+06 mm^3, found 1 of "));
}

TEST(ReportText, IsTheReportWithoutFiles) {
  const auto report = nlohmann::json::parse(report_text(ball_outcome()));
  EXPECT_EQ(report["surface"]["closed"], true);
  EXPECT_FALSE(report.contains("files"));
}

}  // namespace
}  // namespace mesamis
