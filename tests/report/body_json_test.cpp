// SPDX-License-Identifier: Apache-2.0
#include "mesamis/report/body_json.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace mesamis {
namespace {

BodyOutput two_parts() {
  BodyOutput body;
  body.elements.points.resize(6);
  body.elements.cells = {{0, 1, 2, 3}, {0, 1, 2, 4}, {0, 1, 2, 5}};
  body.elements.parts = {{"PART_1", "left"}, {"PART_2", "right"}};
  body.elements.part_of_cell = {0, 1, 1};
  body.elements.sets = {{"load", {{0, 1}, {1, 1}}, {0, 2, 3, 4}}};
  body.facts.quality = {3, 20, 120, 0.4, 1, 0.75};
  body.facts.element_size = 2.5;
  body.facts.parts_dropped = 7;
  body.tolerance = 0.25;
  return body;
}

TEST(BodyJson, TellsElementsPartsAndSets) {
  const auto json = body_json(two_parts());
  EXPECT_EQ(json["element"], "tet4");
  EXPECT_EQ(json["elements"], 3);
  EXPECT_EQ(json["nodes"], 6);
  EXPECT_EQ(json["element_size_mm"], 2.5);
  EXPECT_EQ(json["tolerance_mm"], 0.25);
  EXPECT_EQ(json["least_angle_deg"], 20);
  EXPECT_EQ(json["scaled_jacobian_min"], 0.4);
  EXPECT_EQ(json["share_scaled_jacobian_above_0.2"], 0.75);
  EXPECT_EQ(json["components_dropped"], 7);
  EXPECT_EQ(json["parts"].dump(), R"([{"name":"PART_1","object":"left","elements":1},)"
                                  R"({"name":"PART_2","object":"right","elements":2}])");
  EXPECT_EQ(json["sets"].dump(), R"([{"name":"load","faces":2,"nodes":4}])");
  EXPECT_TRUE(json["material"].is_null());
}

TEST(BodyJson, TellsMidSideNodesAndMaterials) {
  BodyOutput body = two_parts();
  body.elements.mid_nodes.resize(3);
  body.elements.materials = {{"MAT_001", 100, 0.3, 1}, {"MAT_002", 50, 0.3, 1}};
  body.material = MaterialReport{.law = "some", .citation = "who", .doi = {}};
  body.material->share_outside_law = 0.5;
  const auto json = body_json(body);
  EXPECT_EQ(json["element"], "tet10");
  EXPECT_EQ(json["material"]["law"], "some");
  EXPECT_EQ(json["material"]["bins"], 2);
  EXPECT_EQ(json["material"]["share_outside_law"], 0.5);
}

}  // namespace
}  // namespace mesamis
