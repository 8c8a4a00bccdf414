// SPDX-License-Identifier: Apache-2.0
#include "mesamis/run/write.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "mesamis/label_files/read_labels.h"
#include "mesamis/report/json_file.h"
#include "mesamis/report/label_output.h"
#include "mesamis/run/run_files.h"
#include "mesamis/shape_files/object_files.h"
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

/// Two bars beside each other along an axis of an oblique grid, through the whole of it.
LabelMap two_bars(std::size_t axis) {
  LabelMap map;
  map.size = {16, 16, 16};
  map.size[axis] = 9;
  map.spacing = {0.7, 0.7, 0.7};
  map.spacing[static_cast<int>(axis)] = 0.9;
  map.origin = {-101.3, 57.7, 811.1};
  const double c = std::cos(0.4), s = std::sin(0.4);
  map.direction.rows = {{{c, -s, 0}, {s * c, c * c, -s}, {s * s, c * s, c}}};
  map.segments = {{"left", 1, 0, {255, 0, 0}}, {"right", 2, 0, {0, 255, 0}}};
  map.layers.emplace_back(map.voxel_count());
  for (std::size_t n = 0; n < map.voxel_count(); ++n) {
    const auto v = map.voxel(n);
    const Index a = v[(axis + 1) % 3], b = v[(axis + 2) % 3];
    const bool inside = a >= 3 && a < 13 && b >= 3 && b < 13;
    map.layers[0][n] = static_cast<std::uint16_t>(!inside ? 0 : a < 8 ? 1 : 2);
  }
  return map;
}

/// Voxels of a label in each slice across an axis.
std::vector<int> slice_counts(const LabelMap& map, std::size_t axis, int label) {
  std::vector<int> counts(static_cast<std::size_t>(map.size[axis]));
  for (std::size_t n = 0; n < map.voxel_count(); ++n) {
    if (map.layers[0][n] == label) ++counts[static_cast<std::size_t>(map.voxel(n)[axis])];
  }
  return counts;
}

/// The surfaces of these labels as a label map, from a run and from its surface file.
std::array<LabelMap, 2> round_trip(const LabelMap& labels, const fs::path& folder) {
  Request request;
  request.labels = LabelChoice{labels};
  request.mesh = false;
  Outputs out;
  out.labelmap = folder / "a.nrrd";
  out.surfaces = {folder / "a.3mf"};
  write(segment(std::move(request)), out);
  const std::vector<NamedSurface> objects = in_lps(read_object_file(folder / "a.3mf"));
  std::vector<FoundObject> found;
  for (const NamedSurface& o : objects) found.push_back({o.surface, {o.name, o.label, 0, {}}});
  return {read_label_map(folder / "a.nrrd").map, labels_of_surfaces(labels, found).map};
}

TEST(WriteOutcome, LabelMapsKeepTheSlicesAtBothBorders) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const TempFolder folder;
    const LabelMap labels = two_bars(axis);
    const auto maps = round_trip(labels, folder.path());
    for (const LabelMap& map : {maps[0], maps[1], round_trip(maps[0], folder.path())[0]}) {
      for (const int label : {1, 2}) {
        const std::vector<int> counts = slice_counts(map, axis, label);
        // 50 voxels, but for the rounded edges of the bars.
        EXPECT_THAT(counts, testing::Each(testing::AllOf(testing::Ge(30), testing::Le(62))));
        EXPECT_NEAR(counts.front(), counts.back(), 3);
      }
    }
  }
}

TEST(ReportText, IsTheReportWithoutFiles) {
  const auto report = nlohmann::json::parse(report_text(ball_outcome()));
  EXPECT_EQ(report["surface"]["closed"], true);
  EXPECT_FALSE(report.contains("files"));
}

}  // namespace
}  // namespace mesamis
