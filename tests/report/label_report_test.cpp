// SPDX-License-Identifier: Apache-2.0
#include "mesamis/report/label_report.h"

#include <gmock/gmock.h>

#include <limits>
#include <nlohmann/json.hpp>
#include <string>

#include "mesamis/report/report.h"

namespace mesamis {
namespace {

const TriMesh kTetrahedron{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                           {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};

LabelledObject object_of(const std::string& name, Index label, const TriMesh& surface) {
  LabelledObject object;
  object.segment.name = name;
  object.segment.label = label;
  object.surface = surface;
  object.triangles_extracted = 90;
  return object;
}

LabelResult two_objects() {
  LabelResult result;
  result.has_image = true;
  result.margin = 2.5;
  result.parameters.tolerance = 0.1;
  TriMesh open = kTetrahedron;
  open.triangles.pop_back();
  result.objects.push_back(object_of("femur", 3, kTetrahedron));
  result.objects.back().expected_error = {0.1, 0.1, 0.1, 0.1};
  result.objects.push_back(object_of("hip", 4, open));
  result.boundaries = {{"", "femur", 150, -300, true}, {"femur", "hip", 260, 12, false}};
  return result;
}

std::vector<SurfaceCheck> checks_of(const LabelResult& result) {
  std::vector<SurfaceCheck> checks;
  for (const auto& object : result.objects) checks.push_back(check_surface(object.surface));
  return checks;
}

TEST(LabelReport, ListsObjectsAndBoundaries) {
  const LabelResult result = two_objects();
  const auto report = label_run_json({}, result, checks_of(result));
  const auto& object = report["object"];
  EXPECT_EQ(object["margin_mm"], 2.5);
  ASSERT_EQ(object["surfaces"].size(), 2U);
  EXPECT_EQ(object["surfaces"][0]["name"], "femur");
  EXPECT_EQ(object["surfaces"][0]["label"], 3);
  EXPECT_EQ(object["surfaces"][0]["closed"], true);
  EXPECT_NEAR(object["surfaces"][0]["expected_error_mm"]["mean"].get<double>(), 0.1, 1e-9);
  EXPECT_EQ(object["surfaces"][1]["closed"], false);
  EXPECT_TRUE(object["surfaces"][1]["expected_error_mm"].is_null());
  ASSERT_EQ(object["boundaries"].size(), 2U);
  EXPECT_TRUE(object["boundaries"][0]["between"][0].is_null()) << "the background";
  EXPECT_EQ(object["boundaries"][0]["placed_by"], "image");
  EXPECT_EQ(object["boundaries"][1]["placed_by"], "labels");
  EXPECT_TRUE(report.contains("quality"));
}

/// All that a report of one object has of its surface, but for its level and parts.
TEST(LabelReport, HasTheFieldsOfASurfaceForEachObject) {
  LabelResult result = two_objects();
  result.decimated = 0.08;
  result.objects[1].surface.triangles.push_back(kTetrahedron.triangles.back());
  const auto report = label_run_json({}, result, checks_of(result));
  Result one;
  one.parameters.tolerance = 0.1;
  one.surface = kTetrahedron;
  one.expected_error = {0.1, 0.1, 0.1, 0.1};
  one.iterations.resize(1);
  const auto of_one = run_json({}, one, check_surface(kTetrahedron));
  for (const auto& surface : report["object"]["surfaces"]) {
    for (const auto& [field, value] : of_one["surface"].items()) {
      if (field == "level_native" || field == "level_grey" || field == "parts") continue;
      EXPECT_TRUE(surface.contains(field)) << field;
    }
    EXPECT_EQ(surface["kind"], "solid");
    EXPECT_EQ(surface["tolerance_mm"], 0.1);
    EXPECT_EQ(surface["distance_extracted_to_result_max"], 0.08);
    EXPECT_EQ(surface["distance_result_to_extracted_max"], 0.08);
    EXPECT_EQ(surface["self_intersections"], 0);
  }
  result.parameters.tolerance = std::numeric_limits<double>::infinity();
  const auto unbounded = label_run_json({}, result, checks_of(result));
  EXPECT_TRUE(unbounded["object"]["surfaces"][0]["tolerance_mm"].is_null());
  EXPECT_TRUE(unbounded["object"]["surfaces"][0]["distance_result_to_extracted_max"].is_null());
}

TEST(LabelReport, TellsOfSettingsAsThatOfOneObjectDoes) {
  const LabelResult result = two_objects();
  Settings asked;
  asked.tolerance = 0.1;
  const auto report = label_run_json(asked, result, checks_of(result));
  EXPECT_EQ(report["given"], nlohmann::ordered_json({"tolerance"}));
  EXPECT_EQ(report["chosen"]["tolerance"]["source"], "given");
  EXPECT_EQ(report["chosen"]["noise"]["source"], "measured");
  EXPECT_FALSE(report["chosen"].contains("level"));
  EXPECT_TRUE(report["grey"].contains("window_native"));
}

TEST(LabelReport, HasNoLevelOfABoundaryThatLabelsPlaced) {
  const LabelResult result = two_objects();
  const auto boundaries = label_run_json({}, result, checks_of(result))["object"]["boundaries"];
  EXPECT_EQ(boundaries[0]["level_native"], 150);
  EXPECT_EQ(boundaries[0]["contrast_native"], -300);
  EXPECT_FALSE(boundaries[1].contains("level_native"));
  EXPECT_FALSE(boundaries[1].contains("contrast_native"));
}

TEST(LabelReport, OfLabelsAloneSaysNothingOfAnImage) {
  LabelResult result = two_objects();
  result.has_image = false;
  const auto report = label_run_json({}, result, checks_of(result));
  EXPECT_TRUE(report["object"]["margin_mm"].is_null());
  EXPECT_FALSE(report.contains("quality"));
  EXPECT_FALSE(report.contains("settings"));
}

TEST(LabelReport, JudgesEachSurface) {
  LabelResult result = two_objects();
  const Verdict open = judge(result, checks_of(result));
  EXPECT_EQ(open.kind, VerdictKind::kNotClosed);
  EXPECT_NE(open.message.find("'hip'"), std::string::npos);
  result.objects.pop_back();
  EXPECT_EQ(judge(result, checks_of(result)).kind, VerdictKind::kKept);
}

TEST(LabelReport, JudgesTheAccuracyOfEachObject) {
  LabelResult result = two_objects();
  result.objects[1].surface = result.objects[0].surface;
  const auto verdict_for = [&](double accuracy, double first, double second) {
    result.parameters.accuracy = accuracy;
    const double errors[] = {first, second};
    for (std::size_t n = 0; n < 2; ++n) {
      LabelledObject& object = result.objects[n];
      object.expected_error.assign(object.surface.points.size(), errors[n]);
    }
    return judge(result, checks_of(result));
  };
  EXPECT_EQ(verdict_for(0, 0.3, 0.3).kind, VerdictKind::kKept) << "none was asked for";
  EXPECT_EQ(verdict_for(0.3, 0.2, 0.25).kind, VerdictKind::kKept);
  const Verdict one = verdict_for(0.3, 0.2, 0.4);
  EXPECT_EQ(one.kind, VerdictKind::kNotConverged);
  EXPECT_EQ(one.message, "'" + result.objects[1].segment.name +
                             "': accuracy: expected 0.3 mm in the mean at most, found 0.4 mm to "
                             "expect");
  EXPECT_THAT(verdict_for(0.1, 0.2, 0.4).message, testing::EndsWith("; 1 more object too"));
  result.objects[1].expected_error.clear();
  EXPECT_NE(judge(result, checks_of(result)).message, "");
}

TEST(LabelReport, JudgesTheFlow) {
  LabelResult result = two_objects();
  result.objects.pop_back();
  result.flow_converged = false;
  EXPECT_EQ(judge(result, checks_of(result)).kind, VerdictKind::kNotConverged);
}

}  // namespace
}  // namespace mesamis
