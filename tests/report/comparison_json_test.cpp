// SPDX-License-Identifier: Apache-2.0
#include "mesamis/report/comparison_json.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace mesamis {
namespace {

TEST(DistancesJson, SummarisesVerticesAndArea) {
  const DirectedDistances distances{"a", {3, 4, 5}, {1, 1}};
  const auto json = distances_json(distances);
  EXPECT_EQ(json["vertices"], 3);
  EXPECT_DOUBLE_EQ(json["mean"], 4);
  EXPECT_DOUBLE_EQ(json["max"], 5);
  EXPECT_EQ(json["by_area"]["samples"], 2);
  EXPECT_DOUBLE_EQ(json["by_area"]["rms"], 1);
  const auto paper = paper_distances_json(distances);
  EXPECT_DOUBLE_EQ(paper["hausdorff"], 5);
  EXPECT_DOUBLE_EQ(paper["average_hausdorff"], 4);
  EXPECT_DOUBLE_EQ(paper["least_local"], 3);
}

TEST(ObjectsJson, HasBothDirectionsOfEachObject) {
  const DirectedDistances there{"surface_to_reference", {1}, {2}};
  const DirectedDistances back{"reference_to_surface", {3}, {4}};
  const auto json = objects_json({{"femur", {there, back}}});
  ASSERT_EQ(json.size(), 1u);
  EXPECT_EQ(json[0]["name"], "femur");
  EXPECT_EQ(json[0]["surface_to_reference"], distances_json(there));
  EXPECT_EQ(json[0]["reference_to_surface"], distances_json(back));
  EXPECT_TRUE(objects_json({}).is_array());
}

TEST(FramesJson, WhatNoFileStatesIsNull) {
  SurfacePair pair;
  pair.surface_frame = Frame::kRas;
  pair.surface_turned = true;
  const auto json = frames_json(pair);
  EXPECT_TRUE(json["reference"].is_null());
  EXPECT_EQ(json["surface"], "RAS");
  EXPECT_EQ(json["surface_turned"], true);
  EXPECT_TRUE(json["fits_better_flipped"].is_null());
}

}  // namespace
}  // namespace mesamis
