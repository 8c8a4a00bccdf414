// SPDX-License-Identifier: Apache-2.0
#include "mesamis/page/figures.h"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

namespace mesamis {
namespace {

using nlohmann::json;

TEST(FigureText, IsForPeople) {
  EXPECT_EQ(figure_text(1234567), "1\u202f234\u202f567");
  EXPECT_EQ(figure_text(-123), "-123");
  EXPECT_EQ(figure_text(0.0625), "0.0625");
  EXPECT_EQ(figure_text(3.14159), "3.142");
  EXPECT_EQ(figure_text(5575.28), "5\u202f575");
  EXPECT_EQ(figure_text(2.5e-7), "2.500e-07");
  EXPECT_EQ(figure_text(true), "yes");
  EXPECT_EQ(figure_text(nullptr), "–");
  EXPECT_EQ(figure_text(json::array({1, 2.5, "x"})), "1, 2.5, x");
  EXPECT_EQ(figure_text(json::array()), "none");
}

TEST(Datum, HoldsTheExactValueAndItsPointer) {
  const json report{{"a", {{"b", 5575.28}, {"w", "<i>\"x\"</i>"}}}};
  EXPECT_EQ(datum(report, "/a/b").str(),
            "<data value=\"5575.28\" data-of=\"/a/b\">5\u202f575</data>");
  EXPECT_THAT(datum(report, "/a/b", "mm").str(), testing::EndsWith("</data>\u00a0mm"));
  EXPECT_THAT(datum(report, "/a/w", "mm").str(), testing::EndsWith("&lt;/i&gt;</data>"))
      << "no number";
  EXPECT_THAT(datum(report, "/none/0").str(), testing::HasSubstr(">–<"));
}

TEST(FigureTable, LeavesOutWhatTheReportLacks) {
  const json report{{"a", 1}, {"b", nullptr}, {"c", ""}};
  const std::string table =
      figure_table(report, "T",
                   {{"one", "/a", "mm"}, {"two", "/b"}, {"three", "/c"}, {"four", "/d"}})
          .str();
  EXPECT_THAT(table, testing::HasSubstr("one"));
  for (const char* name : {"two", "three", "four"}) {
    EXPECT_THAT(table, testing::Not(testing::HasSubstr(name)));
  }
  EXPECT_TRUE(figure_table(report, "T", {{"four", "/d"}}).is_empty());
}

TEST(NativeUnit, IsThatOfTheModality) {
  EXPECT_EQ(native_unit({{"input", {{"modality", "CT"}}}}), "HU");
  EXPECT_EQ(native_unit(json::object()), "native units");
}

}  // namespace
}  // namespace mesamis
