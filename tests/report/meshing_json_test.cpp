// SPDX-License-Identifier: Apache-2.0
#include "mesamis/report/meshing_json.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace mesamis {
namespace {

TEST(MeshingJson, TellsEachPromiseAndWhetherAllWereKept) {
  MeshingQuality quality{{23.5, 0.995}, 0.2, 0.125, 0.1875, 0};
  auto json = meshing_json(quality);
  EXPECT_EQ(json["least_angle_deg"], 23.5);
  EXPECT_EQ(json["share_above_30_deg"], 0.995);
  EXPECT_EQ(json["tolerance_mm"], 0.2);
  EXPECT_EQ(json["distance_meshing_to_printing_max"], 0.125);
  EXPECT_EQ(json["distance_printing_to_meshing_max"], 0.1875);
  EXPECT_EQ(json["self_intersections"], 0);
  EXPECT_EQ(json["kept"], true);
  quality.self_intersections = 2;
  json = meshing_json(quality);
  EXPECT_EQ(json["self_intersections"], 2);
  EXPECT_EQ(json["kept"], false);
}

}  // namespace
}  // namespace mesamis
