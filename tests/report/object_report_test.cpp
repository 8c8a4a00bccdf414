// SPDX-License-Identifier: Apache-2.0
#include "mesamis/report/object_report.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>
#include <string>

namespace mesamis {
namespace {

using nlohmann::ordered_json;

TEST(ObjectJson, OfAPlainRunNamesNothing) {
  const ordered_json json = object_json({}, {});
  EXPECT_TRUE(json["tissue"].is_null());
  EXPECT_TRUE(json["mask"].is_null());
  EXPECT_TRUE(json["padding"].is_null());
  EXPECT_EQ(json["level_from"], "run");
  EXPECT_EQ(json["image"], "scan");
  EXPECT_TRUE(json["removed"].empty());
  EXPECT_TRUE(json["seeds_mm"].empty());
}

TEST(ObjectJson, TellsWhatWasDone) {
  ObjectRequest request;
  request.seeds = {{1, -2, 3.5}};
  request.mask = LabelMap{};
  request.margin = 4;
  ChosenObject chosen;
  chosen.tissue = "airway";
  chosen.kind = TissueKind::kDark;
  chosen.level = {400, LevelSource::kScan};
  chosen.removed = {{"table or head rest", 146'000}};
  chosen.padding = FilledPadding{12, -3024, -1000};
  const ordered_json json = object_json(request, chosen);
  EXPECT_EQ(json["tissue"], "airway");
  EXPECT_EQ(json["image"], "mirrored");
  EXPECT_EQ(json["level_from"], "whole scan");
  EXPECT_EQ(json["mask"]["margin_mm"], 4);
  EXPECT_EQ(json["seeds_mm"].dump(), "[[1.0,-2.0,3.5]]");
  EXPECT_EQ(json["removed"].dump(), R"([{"what":"table or head rest","cm3":146.0}])");
  EXPECT_EQ(json["padding"].dump(), R"({"voxels":12,"value":-3024.0,"filled_with":-1000.0})");
}

TEST(ObjectJson, NamesEachSourceOfALevelDifferently) {
  ChosenObject chosen;
  std::set<std::string> names;
  for (const LevelSource source :
       {LevelSource::kRun, LevelSource::kUser, LevelSource::kScan, LevelSource::kCrop,
        LevelSource::kTissue, LevelSource::kLabels}) {
    chosen.level = {0, source};
    names.insert(object_json({}, chosen)["level_from"].get<std::string>());
  }
  EXPECT_EQ(names.size(), 6U);
}

}  // namespace
}  // namespace mesamis
