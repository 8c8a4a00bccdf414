// SPDX-License-Identifier: Apache-2.0
#include "mesamis/method/setting_table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <iterator>
#include <limits>

#include "mesamis/base/error.h"
#include "support/throws.h"

namespace mesamis {
namespace {

std::string refusal(const Settings& settings) {
  try {
    require_valid(settings);
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

TEST(Settings, DefaultsAreValid) { EXPECT_EQ(refusal({}), ""); }

TEST(Settings, ARefusedValueNamesItsRange) {
  Settings settings;
  settings.beta = -1;
  EXPECT_EQ(refusal(settings), "beta: expected 1e-12 to 1e+12, found -1");
  settings = {};
  settings.adaptations = -1;
  EXPECT_THAT(refusal(settings), ::testing::HasSubstr("adaptations"));
  settings = {};
  settings.gradation = 1;
  EXPECT_EQ(refusal(settings), "gradation (other than 0): expected 1.01 to 1000, found 1");
  settings.gradation = 1.5;
  EXPECT_EQ(refusal(settings), "");
  settings = {};
  settings.tolerance = -0.1;
  EXPECT_THAT(refusal(settings), ::testing::HasSubstr("tolerance"));
  settings = {};
  settings.triangles = 3;
  EXPECT_THAT(refusal(settings), ::testing::HasSubstr("triangles"));
  settings = {};
  settings.window = Window{3, 3};
  EXPECT_EQ(refusal(settings), "window: expected low below high, found 3,3");
  settings = {};
  settings.preview = true;
  EXPECT_EQ(refusal(settings), "");
  settings.surface = SurfaceKind::kBand;
  EXPECT_EQ(refusal(settings), "preview: expected surface solid, found band");
}

TEST(Settings, NothingThatIsNotANumberPasses) {
  for (double Settings::*member :
       {&Settings::epsilon, &Settings::beta, &Settings::tol_v, &Settings::solver_tolerance,
        &Settings::tau, &Settings::tol_mesh, &Settings::tol_energy, &Settings::h_min,
        &Settings::band_threshold}) {
    Settings settings;
    settings.*member = std::numeric_limits<double>::quiet_NaN();
    EXPECT_NE(refusal(settings), "");
    settings.*member = std::numeric_limits<double>::infinity();
    EXPECT_NE(refusal(settings), "");
  }
}

TEST(Settings, WhatIsKnownOfTheImageIsChecked) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double value : {-1.0, nan}) {
    Settings settings;
    settings.noise = value;
    EXPECT_THAT(refusal(settings), ::testing::HasSubstr("noise: expected 0"));
    settings = {};
    settings.blur = {1, value, 1};
    EXPECT_THAT(refusal(settings), ::testing::HasSubstr("blur: expected 0 to 3"));
    settings = {};
    settings.gamma = value;
    EXPECT_THAT(refusal(settings), ::testing::HasSubstr("gamma: expected"));
  }
}

/// A value other than the default, for any row.
SettingValue other_value(const Setting& setting) {
  const SettingValue value = setting.get(Settings{});
  if (const auto* on = std::get_if<bool>(&value)) return !*on;
  if (setting.count == 0) return setting.words.back();
  if (setting.name == "crop") return std::vector<double>{1, 9, 0, 8, 2, -1};
  std::vector<double> numbers(setting.count);
  const double low = std::max(setting.low, -100.0), high = std::min(setting.high, 1000.0);
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const double share = 0.3 + 0.2 * static_cast<double>(i);
    const double number = low + share * (high - low);
    numbers[i] = setting.whole ? std::floor(number) : number;
  }
  return numbers;
}

TEST(SettingTable, EveryRowSetsItsOwnMemberAndNoOther) {
  for (const Setting& row : setting_table()) {
    SCOPED_TRACE(row.name);
    const SettingValue value = other_value(row);
    Settings settings;
    set_setting(settings, row, value);
    EXPECT_EQ(row.get(settings), value);
    EXPECT_EQ(origin_of(row, settings), Origin::kGiven);
    for (const Setting& other : setting_table()) {
      if (other.name == row.name) continue;
      EXPECT_EQ(other.get(settings), other.get({})) << other.name;
    }
  }
}

TEST(SettingTable, EveryValueReadsBackFromItsText) {
  for (const Setting& row : setting_table()) {
    SCOPED_TRACE(row.name);
    for (const SettingValue& value : {row.get(Settings{}), other_value(row)}) {
      EXPECT_EQ(parse_value(row, text_of(row, value)), value);
    }
    for (const std::string& word : row.words) {
      Settings settings;
      set_setting(settings, row, parse_value(row, word));
      EXPECT_EQ(refusal(settings), "") << word;
    }
  }
}

TEST(SettingTable, RowsAreComplete) {
  for (const Setting& row : setting_table()) {
    SCOPED_TRACE(row.name);
    EXPECT_FALSE(row.help.empty());
    EXPECT_FALSE(row.help.ends_with('.'));
    EXPECT_EQ(&find_setting(row.name), &row);
    const auto& words = row.words;
    const bool has_auto = std::find(words.begin(), words.end(), "auto") != words.end();
    EXPECT_EQ(has_auto, !row.automatic.empty()) << "whoever offers auto says how it is found";
    const SettingValue by_default = row.get(Settings{});
    const bool is_measured =
        by_default == SettingValue("auto") || by_default == SettingValue("local");
    EXPECT_EQ(has_auto, is_measured) << "what can be measured is measured by default";
  }
  EXPECT_REFUSED(find_setting("gama"), ::testing::HasSubstr("no setting 'gama'"));
}

TEST(SettingTable, TextMayBeShortWhereNothingIsLost) {
  const Setting& stride = find_setting("stride");
  EXPECT_EQ(parse_value(stride, "2"), SettingValue(std::vector<double>{2, 2, 2}));
  const Setting& crop = find_setting("crop");
  EXPECT_EQ(parse_value(crop, "10:20,,"), SettingValue(std::vector<double>{10, 20, 0, -1, 0, -1}));
  EXPECT_EQ(parse_value(crop, ":20,3:,:"), SettingValue(std::vector<double>{0, 20, 3, -1, 0, -1}));
  EXPECT_EQ(parse_value(find_setting("beta"), "+1e3"), SettingValue(std::vector<double>{1000}));
}

TEST(SettingTable, RefusesTextThatIsNoValue) {
  const auto refused = [](const char* name, const char* text, const char* why) {
    Settings settings;
    EXPECT_REFUSED(set_setting(settings, find_setting(name), parse_value(find_setting(name), text)),
                   ::testing::HasSubstr(why));
  };
  refused("stride", "1,1", "expected X,Y,Z|auto, found '1,1'");
  refused("stride", "1,1,1,", "expected X,Y,Z");
  refused("stride", "0", "stride: expected 1 to 1000, found 0");
  refused("stride", "1.5", "expected a whole number, found 1.5");
  refused("crop", "1:2:3,,", "expected I0:I1,J0:J1,K0:K1");
  refused("crop", "0:4294967297,,", "crop: expected -1 to 2.14748e+09");
  refused("surface", "5", "expected solid|band, found '5'");
  refused("gamma", "much", "expected X|auto, found 'much'");
  refused("gamma", "", "expected X|auto");
  refused("level", "nan", "expected X|auto|local");
  refused("drafts", "maybe", "expected yes|no");
}

TEST(Settings, ABlurToUndoNeedsRestoring) {
  Settings settings;
  settings.restore = false;
  settings.blur = {1, 1, 0};
  EXPECT_EQ(refusal(settings), "blur: expected none where restore is off, found 1,1,0");
  settings.blur = {0, 0, 0};
  EXPECT_EQ(refusal(settings), "");
}

TEST(SettingTable, ToleranceMeansTheSameGivenOrNot) {
  const Setting& row = find_setting("tolerance");
  Settings settings;
  EXPECT_EQ(row.get(settings), SettingValue("auto"));
  set_setting(settings, row, "none");
  EXPECT_EQ(settings.tolerance, std::numeric_limits<double>::infinity());
  EXPECT_EQ(text_of(row, row.get(settings)), "none");
}

TEST(Presets, PaperIsTheMethodAsPrinted) {
  const Settings paper = preset_settings("paper");
  EXPECT_EQ(refusal(paper), "");
  EXPECT_EQ(paper.length_unit, LengthUnit::kMm);
  EXPECT_EQ(paper.epsilon, 1e-3);
  EXPECT_EQ(paper.eta, std::nullopt) << "epsilon squared";
  EXPECT_EQ(paper.beta, 2);
  EXPECT_EQ(paper.gamma, 0.1);
  EXPECT_EQ(paper.tol_v, 1e-2);
  EXPECT_EQ(paper.amis_iterations, 10);
  EXPECT_EQ(paper.tau, 1e-2);
  EXPECT_EQ(paper.tol_mesh, 1e-2);
  EXPECT_EQ(paper.tol_energy, 1e-2);
  EXPECT_EQ(paper.band_threshold, 1e-1);
  EXPECT_EQ(paper.max_tets, 1'300'000);
  EXPECT_EQ(paper.threshold_rule, ThresholdRule::kPaper);
  EXPECT_EQ(paper.surface, SurfaceKind::kBand);
  EXPECT_EQ(paper.until, StopRule::kEither);
  EXPECT_FALSE(paper.restore);
  EXPECT_FALSE(paper.drafts);
}

TEST(Presets, DefaultIsTheTableAndOthersAreRefused) {
  for (const Setting& row : setting_table()) {
    EXPECT_EQ(row.get(preset_settings("default")), row.get({})) << row.name;
  }
  EXPECT_REFUSED(preset_settings("fast"), ::testing::HasSubstr("expected default or paper"));
}

TEST(SettingsPage, IsThatOfTheDocs) {
  std::ifstream file(MESAMIS_SOURCE_DIR "/docs/settings.md");
  const std::string page{std::istreambuf_iterator<char>(file), {}};
  EXPECT_EQ(page, settings_page())
      << "docs/settings.md is stale: mesamis settings --markdown > docs/settings.md";
}

}  // namespace
}  // namespace mesamis
