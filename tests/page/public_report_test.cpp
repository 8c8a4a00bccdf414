// SPDX-License-Identifier: Apache-2.0
#include "mesamis/page/public_report.h"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "page/sample_run.h"

namespace mesamis {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::Not;

TEST(PublicReport, NamesNobody) {
  const std::string shown = public_report(sample_report(), false).dump();
  EXPECT_THAT(shown, Not(HasSubstr("UNMISTAKABLE")));
  EXPECT_THAT(shown, Not(HasSubstr("/home")));
  EXPECT_THAT(shown, HasSubstr("(not shown).nii.gz"));
}

TEST(PublicReport, CountsWarningsThatMayNameSomebody) {
  const std::string read = "taken as the only volume among the series Miller knee, 3 May";
  const std::string level = "surface: the level 312.4 HU is likely that of the skin";
  json report = sample_report();
  report["input"]["warnings"] = {read, "surface: lies in Miller.dcm"};
  report["warnings"] = {read,
                        "surface: lies in Miller.dcm",
                        level,
                        "tissue: 'Miller' is not here",
                        "the first 1.dcm of Miller",
                        7};
  const json shown = public_report(report, false);
  EXPECT_EQ(
      shown["warnings"],
      json({level,
            "5 warnings hidden, which may name files or people: see the report or --html-names"}));
  EXPECT_EQ(
      shown["input"]["warnings"],
      json::array(
          {"2 warnings hidden, which may name files or people: see the report or --html-names"}));
  EXPECT_EQ(public_report(report, true)["warnings"], report["warnings"]);
  report["warnings"] = {read};
  EXPECT_EQ(
      public_report(report, false)["warnings"],
      json::array(
          {"1 warning hidden, which may name files or people: see the report or --html-names"}));
  report["warnings"] = json::array();
  EXPECT_EQ(public_report(report, false)["warnings"], json::array());
}

TEST(PublicReport, KeepsAVerdictOfNumbersAlone) {
  const auto shown = [](const std::string& message, bool names) {
    const json report{{"verdict", {{"kept", false}, {"message", message}}}};
    return public_report(report, names)["verdict"]["message"].get<std::string>();
  };
  const std::string numbers = "tolerance: expected distances of 0.3 mm at most, found 0.5 and 0.4";
  EXPECT_EQ(shown(numbers, false), numbers);
  for (const char* naming : {"'Miller': expected a closed surface", "/home/miller: not closed"}) {
    EXPECT_THAT(shown(naming, false), HasSubstr("see the report or --html-names"));
    EXPECT_EQ(shown(naming, true), naming);
  }
}

TEST(PublicReport, IsNotGarbledByAScanOfAShortName) {
  json report = sample_report();
  report["input"]["path"] = "1";
  report["input"]["warnings"] = json::array();
  report["warnings"] = {"surface: the level 111 HU is likely that of the skin"};
  EXPECT_EQ(public_report(report, false)["warnings"], report["warnings"]);
}

TEST(PublicReport, TakesReportsOfAnyShape) {
  for (const char* text :
       {R"({"output": "x", "body": 3, "iterations": 3, "warnings": 5, "verdict": []})",
        R"({"output": [1], "iterations": [3], "input": "x"})",
        R"({"iterations": {"a": 1}, "input": {"warnings": "x", "path": 3}, "command": 4})",
        R"(["a"])", "3", "null"}) {
    for (const bool names : {false, true}) {
      EXPECT_NO_THROW(public_report(json::parse(text), names)) << text;
      EXPECT_NO_THROW(repeat_command(json::parse(text), names)) << text;
    }
  }
}

TEST(PublicReport, HoldsNothingThatDiffersFromRunToRun) {
  for (const bool names : {false, true}) {
    const json shown = public_report(sample_report(), names);
    const std::string text = shown.dump();
    for (const char* key : {"seconds", "peak_memory", "threads"})
      EXPECT_THAT(text, Not(HasSubstr(key)));
    EXPECT_EQ(shown["surface"], sample_report()["surface"]);
  }
}

TEST(RepeatCommand, StandsForTheRunAndNamesNobody) {
  EXPECT_EQ(repeat_command(sample_report(), false),
            "mesamis segment SCAN -o surface.stl --level 175 --error --name NAME");
}

TEST(RepeatCommand, HasAllWordsWhereNamesAreAskedFor) {
  EXPECT_EQ(repeat_command(sample_report(), true),
            "mesamis segment '/home/x/UNMISTAKABLE NAME/scan.nii.gz' -o UNMISTAKABLE.stl --level "
            "175 --error "
            "--name UNMISTAKABLE");
}

TEST(RepeatCommand, TakesEveryWayToWriteAnOption) {
  const auto repeated = [](const std::vector<std::string>& words) {
    return repeat_command({{"command", words}}, false);
  };
  EXPECT_EQ(repeated({"segment", "--no-restore", "x.nrrd", "-osecret.ply", "--crop", "0:5,,"}),
            "mesamis segment --no-restore SCAN -o surface.ply --crop 0:5,,");
  EXPECT_EQ(repeated({"segment", "x", "--series", "1.2.840", "--settings", "me.json"}),
            "mesamis segment SCAN --series SERIES --settings settings.json");
  EXPECT_EQ(repeated({"segment", "x", "--seed", "-3,4,5", "--tissue=bone", "--label", "it's"}),
            "mesamis segment SCAN --seed -3,4,5 --tissue bone --label 'it'\\''s'");
  EXPECT_EQ(repeated({"segment", "x", "--label", "a", "b", "--bins", "3", "-o", "me.stl", "i.ply"}),
            "mesamis segment SCAN --label a b --bins 3 -o surface.stl surface.ply");
  EXPECT_EQ(repeated({"segment", "x", "-o"}), "mesamis segment SCAN -o");
  EXPECT_THAT(repeat_command(json::object(), false), HasSubstr("--settings report.json"));
}

}  // namespace
}  // namespace mesamis
