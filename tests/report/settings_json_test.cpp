// SPDX-License-Identifier: Apache-2.0
#include "mesamis/report/settings_json.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "mesamis/method/setting_table.h"
#include "support/temp_folder.h"
#include "support/throws.h"

namespace mesamis {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::Le;
using testing::SizeIs;

TEST(SettingsJson, EveryPresetReadsBack) {
  for (const std::string& name : preset_names()) {
    const Settings asked = preset_settings(name);
    Settings read;
    from_json(json(to_json(asked)), read);
    for (const Setting& row : setting_table()) EXPECT_EQ(row.get(read), row.get(asked)) << row.name;
  }
}

TEST(SettingsJson, HasOneEntryPerSettingInTheTablesOrder) {
  const auto object = to_json({});
  ASSERT_EQ(object.size(), setting_table().size());
  auto row = setting_table().begin();
  for (const auto& [name, value] : object.items()) EXPECT_EQ(name, (row++)->name);
  EXPECT_EQ(object["crop"].dump(), "[[0,-1],[0,-1],[0,-1]]");
  EXPECT_EQ(object["stride"], "auto");
  EXPECT_EQ(object["gamma"], "auto");
  EXPECT_EQ(object["beta"].dump(), "2.0");
  EXPECT_EQ(object["adaptations"].dump(), "10");
  EXPECT_EQ(object["restore"], true);
}

TEST(SettingsJson, WhatIsNotNamedStays) {
  Settings settings;
  settings.beta = 5;
  from_json(json{{"gamma", 0.2}, {"max_tets", 1e6}}, settings);
  EXPECT_EQ(settings.beta, 5);
  EXPECT_EQ(settings.gamma, 0.2);
  from_json(json{{"stride", 2}}, settings);
  EXPECT_EQ(settings.stride, (std::array<Index, 3>{2, 2, 2})) << "one number stands for all three";
  EXPECT_EQ(settings.max_tets, 1'000'000);
  from_json(json{{"gamma", "auto"}}, settings);
  EXPECT_EQ(settings.gamma, std::nullopt);
}

TEST(SettingsJson, ReadsRangesAndNumbersAsTheCommandLineHasThem) {
  constexpr CropRange kOpen{{10, 0, 5}, {20, -1, -1}};
  for (const char* text : {R"({"crop": "10:20,,5:"})", R"({"crop": [[10, 20], null, [5, null]]})",
                           R"({"crop": [[10, 20], [null, null], [5, -1]]})"}) {
    Settings settings;
    from_json(json::parse(text), settings);
    EXPECT_EQ(settings.crop, kOpen) << text;
  }
  Settings settings;
  from_json(json{{"crop", ":20,,"}, {"stride", "2"}, {"window", "-200,900"}}, settings);
  EXPECT_EQ(settings.crop, (CropRange{{0, 0, 0}, {20, -1, -1}}));
  EXPECT_EQ(settings.stride, (std::array<Index, 3>{2, 2, 2}));
  EXPECT_EQ(settings.window->high, 900);
  from_json(json{{"stride", "auto"}}, settings);
  EXPECT_EQ(settings.stride, std::nullopt);
}

TEST(SettingsJson, RefusesWhatNoSettingHas) {
  const auto refused = [](const char* text, const char* why) {
    Settings settings;
    EXPECT_REFUSED(from_json(json::parse(text), settings), HasSubstr(why));
  };
  refused("[]", "expected a JSON object");
  refused(R"({"gama": 1})", "no setting 'gama'");
  refused(R"({"gamma": null})", "gamma: expected X|auto, found null");
  refused(R"({"gamma": {}})", "gamma: expected X|auto, found {}");
  refused(R"({"gamma": true})", "gamma: expected X|auto");
  refused(R"({"restore": 1})", "restore: expected yes|no");
  refused(R"({"stride": [1, 1]})", "stride: expected X,Y,Z");
  refused(R"({"stride": [1, 1, 1, 1]})", "stride: expected X,Y,Z");
  refused(R"({"stride": [1, 1, true]})", "stride: expected X,Y,Z");
  refused(R"({"stride": [1, 1, 1.9]})", "expected a whole number, found 1.9");
  refused(R"({"stride": [4294967297, 1, 1]})", "stride: expected 1 to 1000");
  refused(R"({"crop": [[0, 9], [0, 9]]})", "crop: expected");
  refused(R"({"crop": [[0, 9, 3], [0, 9], [0, 9]]})", "crop: expected");
  refused(R"({"crop": [[0, 1e300], [0, 9], [0, 9]]})", "crop: expected -1 to");
  refused(R"({"crop": "10:20"})", "crop: expected I0:I1,J0:J1,K0:K1, found '10:20'");
  refused(R"({"crop": [null, [0, 9]]})", "crop: expected");
  refused(R"({"crop": [[0, "9"], null, null]})", "crop: expected");
  refused(R"({"stride": "fast"})", "stride: expected X,Y,Z|auto, found 'fast'");
  refused(R"({"stride": null})", "stride: expected");
  refused(R"({"max_tets": 300.5})", "max-tets: expected a whole number, found 300.5");
  refused(R"({"surface": "ball"})", "surface: expected solid|band, found 'ball'");
}

TEST(ReadSettings, TakesSettingsOrAReport) {
  const TempFolder folder;
  write_bytes(folder / "s.json", R"({"beta": 3})");
  write_bytes(folder / "r.json", R"({"program": {}, "settings": {"beta": 3}})");
  Settings start;
  start.tau = 0.5;
  for (const char* name : {"s.json", "r.json"}) {
    const Settings read = read_settings(folder / name, start);
    EXPECT_EQ(read.beta, 3) << name;
    EXPECT_EQ(read.tau, 0.5) << name << " does not name it";
  }
}

TEST(ReadSettings, ErrorsNameTheFile) {
  const TempFolder folder;
  write_bytes(folder / "s.json", R"({"beta": -3})");
  EXPECT_REFUSED(read_settings(folder / "s.json", {}), HasSubstr("s.json: beta"));
  write_bytes(folder / "s.json", R"({"h_min": 2, "h_max": 1})");
  EXPECT_REFUSED(read_settings(folder / "s.json", {}), HasSubstr("s.json: h"));
  EXPECT_REFUSED(read_settings(folder / "none.json", {}), HasSubstr("none.json"));
}

TEST(ReadSettings, ErrorsAreShortLinesWhateverTheFileHolds) {
  const TempFolder folder;
  const std::string path = folder / "s.json";
  write_bytes(path, R"({"band_th\u001b\nreshold": 1})");
  EXPECT_REFUSED(read_settings(path, {}), HasSubstr("'band_th??reshold'"));
  const std::string text(100'000, 'x');
  for (const std::string& bytes : {"{\"" + text + "\": 1}", "{\"beta\": \"" + text + "\"}",
                                   "{\"" + text + "\": 1, \"" + text + "\": 1}"}) {
    write_bytes(path, bytes);
    EXPECT_REFUSED(read_settings(path, {}), SizeIs(Le(path.size() + 402)));
  }
}

}  // namespace
}  // namespace mesamis
