// SPDX-License-Identifier: Apache-2.0
#include "mesamis/report/report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>

#include "mesamis/method/setting_table.h"
#include "support/ball_volume.h"
#include "support/temp_folder.h"

namespace mesamis {
namespace {

TEST(RunJson, HoldsTheValuesUsedAndWhereTheyCameFrom) {
  Settings asked;
  asked.max_tets = 3000;
  asked.adaptations = 2;
  const Result result = mes_amis(make_ball({.size = 20, .radius = 6}), asked);
  const auto report = run_json(asked, result, check_surface(result.surface));
  for (const auto& [name, value] : report["settings"].items()) {
    if (name == "triangles" || name == "accuracy") continue;
    EXPECT_NE(value, "auto") << name;
  }
  EXPECT_EQ(report["given"], (nlohmann::json{"max_tets", "adaptations"}));
  EXPECT_EQ(report["settings"]["level"], report["surface"]["level_native"]);
  for (const Setting& setting : setting_table()) {
    ASSERT_EQ(report["chosen"].contains(setting.name), !setting.automatic.empty()) << setting.name;
    if (setting.automatic.empty()) continue;
    const auto& chosen = report["chosen"][setting.name];
    const bool given = origin_of(setting, asked) == Origin::kGiven;
    const bool measured = origin_of(setting, asked) == Origin::kMeasured || setting.name == "level";
    EXPECT_EQ(chosen["value"], report["settings"][setting.name]) << setting.name;
    EXPECT_EQ(chosen["source"], measured ? "measured"
                                : given  ? "given"
                                         : "default")
        << setting.name;
    EXPECT_EQ(chosen["reason"].is_null(), !measured) << setting.name;
  }
  EXPECT_EQ(report["chosen"]["level"]["uncertainty"], report["quality"]["level_uncertainty"]);
  EXPECT_TRUE(report["chosen"]["max_tets"]["uncertainty"].is_null());
  EXPECT_EQ(report["iterations"].size(), result.iterations.size());
  EXPECT_TRUE(report["iterations"][0]["energy_change"].is_null()) << "nothing to compare with";
  EXPECT_EQ(report["surface"]["closed"], true);
}

/// The default of the level, local, is measured; a level is given where somebody gave it.
TEST(RunJson, TellsAMeasuredLevelFromAGivenOne) {
  RunSummary run;
  run.parameters.tolerance = 0.1;
  run.iterations.resize(2);
  for (const bool in_places : {true, false}) {
    run.parameters.local_level = in_places;
    EXPECT_EQ(run_json({}, run)["chosen"]["level"]["source"], "measured") << in_places;
    EXPECT_FALSE(run_json({}, run)["chosen"]["level"]["reason"].is_null()) << in_places;
  }
  Settings asked;
  asked.level = 300;
  EXPECT_EQ(run_json(asked, run)["chosen"]["level"]["source"], "given");
}

TEST(RunJson, TellsThePresetFromTheUser) {
  RunSummary run;
  run.parameters.tolerance = 0.1;
  run.iterations.resize(2);
  Settings asked = preset_settings("paper");
  asked.noise = 3;
  run.parameters.surface = SurfaceKind::kBand;
  run.image.level_uncertainty = 7;
  const auto chosen = run_json(asked, run)["chosen"];
  EXPECT_EQ(chosen["gamma"]["source"], "preset");
  EXPECT_EQ(chosen["noise"]["source"], "given");
  EXPECT_EQ(chosen["blur"]["source"], "measured");
  EXPECT_TRUE(chosen["level"]["uncertainty"].is_null()) << "a band has none";
}

TEST(PrintableJson, NoBoundIsNull) {
  const PrintableReport printable;
  EXPECT_TRUE(
      printable_json(printable, std::numeric_limits<double>::infinity())["tolerance_mm"].is_null());
  EXPECT_EQ(printable_json(printable, 0.25)["tolerance_mm"], 0.25);
  EXPECT_TRUE(printable_json(printable, 0.25)["parts"].is_null());
}

TEST(FactsOf, AreThoseOfTheScan) {
  const TempFolder folder;
  write_bytes(folder / "a", "abc");
  Volume volume = make_ball({.size = 8, .radius = 2});
  volume.modality = "CT";
  volume.origin = {1, -2, 3.5};
  volume.direction = {{Vec3{0, -1, 0}, Vec3{1, 0, 0}, Vec3{0, 0, 1}}};
  const std::vector<ReadFile> files{{folder / "a", state_of(folder / "a")}};
  const auto json = input_json(facts_of({folder / "a", "NRRD", {"odd"}, files}, volume));
  EXPECT_EQ(json["sha256"], "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(json["size"], (nlohmann::json{8, 8, 8}));
  EXPECT_EQ(json["modality"], "CT");
  EXPECT_EQ(json["warnings"], nlohmann::json{"odd"});
  EXPECT_EQ(json["origin_mm"].dump(), "[1.0,-2.0,3.5]");
  EXPECT_EQ(json["direction"].dump(), "[[0.0,1.0,0.0],[-1.0,0.0,0.0],[0.0,0.0,1.0]]")
      << "of the axes i, j, k";
  EXPECT_LT(json["range"][0], json["range"][1]);
}

TEST(ErrorJson, HasMeanPercentileAndGreatest) {
  EXPECT_TRUE(error_json({}).is_null());
  EXPECT_EQ(error_json({0.1, 0.2, 0.5, 1}).dump(), R"({"mean":0.1,"p95":0.2,"max":0.5})");
}

TEST(Producer, IsTheProgramItsVersionAndItsCommit) {
  const auto program = program_json();
  EXPECT_EQ(producer(), "mesamis " + program["version"].get<std::string>() + " (" +
                            program["commit"].get<std::string>() + ")");
}

TEST(ProgramJson, NamesTheProgramAndItsCommit) {
  EXPECT_EQ(program_json()["name"], "mesamis");
  EXPECT_THAT(program_json()["version"].get<std::string>(), testing::MatchesRegex("[0-9.]+"));
}

}  // namespace
}  // namespace mesamis
