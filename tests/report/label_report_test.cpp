// SPDX-License-Identifier: Apache-2.0
#include "mesamis/report/label_report.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

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
  const auto report = label_run_json(result, checks_of(result));
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

TEST(LabelReport, OfLabelsAloneSaysNothingOfAnImage) {
  LabelResult result = two_objects();
  result.has_image = false;
  const auto report = label_run_json(result, checks_of(result));
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

}  // namespace
}  // namespace mesamis
