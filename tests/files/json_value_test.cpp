// SPDX-License-Identifier: Apache-2.0
#include "mesamis/files/json_value.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "support/temp_folder.h"
#include "support/throws.h"

namespace mesamis {
namespace {

using testing::HasSubstr;

nlohmann::json read(const std::string& text, double memory_gb = 0.1) {
  const TempFolder folder;
  write_bytes(folder / "a.json", text);
  MemoryBudget budget(folder / "a.json", {.memory_gb = memory_gb});
  return read_metadata(folder / "a.json", budget);
}

TEST(JsonValue, ReadsWhatIsJson) { EXPECT_EQ(read(R"({"a": [1, 2]})")["a"][1], 2); }

TEST(JsonValue, RefusesWhatIsNoJson) {
  EXPECT_REFUSED(read("{\"a\": 1"), HasSubstr("expected JSON, found something else at byte"));
  EXPECT_REFUSED(read(""), HasSubstr("expected JSON"));
  EXPECT_REFUSED(read("{\"a\": NaN}"), HasSubstr("expected JSON"));
  EXPECT_REFUSED(read("[1e999]"), HasSubstr("in range"));
  EXPECT_REFUSED(read(std::string(100, '[') + std::string(100, ']')), HasSubstr("64 levels"));
  EXPECT_REFUSED(read(std::string(10'000, ' ') + "1", 1e-6), HasSubstr("memory"));
}

TEST(JsonValue, TellsWhereAndWhatItExpected) {
  const std::filesystem::path file("f.json");
  const auto json = nlohmann::json::parse(R"({"a": [1, -2, "x"], "b": null, "c": {"d": 1.5}})");
  const JsonValue value(file, json);
  EXPECT_EQ(value.at("c").at("d").number(), 1.5);
  EXPECT_FALSE(value.find("b"));
  EXPECT_FALSE(value.find("z"));
  EXPECT_REFUSED(value.at("z"), HasSubstr("f.json: JSON: expected an object with \"z\""));
  EXPECT_REFUSED(value.at("a").at("z"), HasSubstr("f.json: a: expected an object with \"z\""));
  EXPECT_REFUSED(value.at("c").at("d").count(), HasSubstr("c.d: expected a whole number"));
  EXPECT_REFUSED(value.at("a").counts(), HasSubstr("a[]: expected a whole number"));
  EXPECT_REFUSED(value.at("a").numbers(), HasSubstr("found \"x\""));
  EXPECT_REFUSED(value.at("c").list(), HasSubstr("expected a list, found an object of 1"));
  EXPECT_REFUSED(value.at("a").text(), HasSubstr("expected a string"));
}

}  // namespace
}  // namespace mesamis
