// SPDX-License-Identifier: Apache-2.0
#include "mesamis/report/json_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <limits>
#include <nlohmann/json.hpp>

#include "support/temp_folder.h"
#include "support/throws.h"

namespace mesamis {
namespace {

using testing::HasSubstr;

TEST(JsonFile, ReadsBackWhatWasWritten) {
  const TempFolder folder;
  const nlohmann::ordered_json value{{"b", 1.25}, {"a", {1, 2}}, {"text", "x"}};
  write_json(folder / "a.json", value);
  EXPECT_EQ(nlohmann::ordered_json(read_json(folder / "a.json")),
            nlohmann::ordered_json(nlohmann::json(value)));
}

TEST(JsonFile, WhatJsonCannotHoldDoesNotBreakTheFile) {
  const TempFolder folder;
  write_json(folder / "a.json", {{"inf", std::numeric_limits<double>::infinity()},
                                 {"bad",
                                  "a\xff"
                                  "b"}});
  const auto back = read_json(folder / "a.json");
  EXPECT_TRUE(back["inf"].is_null());
  EXPECT_TRUE(back["bad"].is_string());
}

TEST(JsonFile, SaysWhereItIsNotJson) {
  const TempFolder folder;
  write_bytes(folder / "a.json", "{\"a\": }");
  EXPECT_REFUSED(read_json(folder / "a.json"), HasSubstr("found something else at byte 7"));
  write_bytes(folder / "huge.json", "{\"a\": 1e999}");
  EXPECT_REFUSED(read_json(folder / "huge.json"), HasSubstr("expected JSON with numbers in range"));
  EXPECT_REFUSED(read_json(folder / "b.json"), HasSubstr("cannot be read: no such file"));
  EXPECT_REFUSED(read_json(folder / "."), HasSubstr("cannot be read: expected a file"));
  ASSERT_EQ(mkfifo((folder / "pipe.json").c_str(), 0600), 0);
  EXPECT_REFUSED(read_json(folder / "pipe.json"), HasSubstr("found neither"));
}

TEST(JsonFile, RefusesWhatIsNestedDeeply) {
  const TempFolder folder;
  const auto nested = [](std::size_t depth) {
    return std::string(depth, '[') + std::string(depth, ']');
  };
  write_bytes(folder / "a.json", nested(64));
  EXPECT_NO_THROW(read_json(folder / "a.json"));
  for (const std::size_t depth : {std::size_t{65}, std::size_t{100'000}}) {
    write_bytes(folder / "a.json", "{\"tau\": " + nested(depth) + "}");
    EXPECT_REFUSED(read_json(folder / "a.json"), HasSubstr("at most 64 levels"));
  }
}

TEST(JsonFile, RefusesAKeyThatComesTwiceInOneObject) {
  const TempFolder folder;
  write_bytes(folder / "a.json", R"({"a": {"x": 1}, "b": {"x": 1}, "c": [{"x": 1}, {"x": 2}]})");
  EXPECT_NO_THROW(read_json(folder / "a.json"));
  for (const char* text : {R"({"a": 1, "a": 1})", R"([{"b": {"a": [], "c": {}, "a": {}}}])"}) {
    write_bytes(folder / "a.json", text);
    EXPECT_REFUSED(read_json(folder / "a.json"), HasSubstr("each key once, found \"a\" twice"));
  }
}

TEST(VecJson, IsAList) { EXPECT_EQ(vec_json({1, 2.5, -3}).dump(), "[1.0,2.5,-3.0]"); }

}  // namespace
}  // namespace mesamis
