// SPDX-License-Identifier: Apache-2.0
#include "mesamis/record/json_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

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
  EXPECT_REFUSED(read_json(folder / "b.json"), HasSubstr("cannot be opened"));
  EXPECT_REFUSED(read_json(folder / "."), HasSubstr("cannot be opened"));
}

TEST(VecJson, IsAList) { EXPECT_EQ(vec_json({1, 2.5, -3}).dump(), "[1.0,2.5,-3.0]"); }

}  // namespace
}  // namespace mesamis
