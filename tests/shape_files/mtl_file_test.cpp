// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "mesamis/shape_files/object_formats.h"
#include "shape_files/object_example.h"
#include "support/throws.h"
#include "support/wide_budget.h"

namespace mesamis {
namespace {

using testing::HasSubstr;

std::map<std::string, Colour> colours_in(const std::string& text) {
  WideBudget budget;
  return parse_mtl("a.mtl", text, budget);
}

TEST(Mtl, GivesBackTheColoursUnderSafeNames) {
  const std::vector<NamedSurface> objects = three_objects();
  const std::string text = mtl_bytes(objects);
  EXPECT_THAT(text, HasSubstr("newmtl H_fte\nKd 0 0.2 0.8\n"));
  const auto colours = colours_in(text);
  const std::vector<std::string> names = safe_names(objects);
  ASSERT_EQ(colours.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(colours.at(names[i]), objects[i].colour);
}

TEST(Mtl, ReadsWhatOthersWrite) {
  const auto colours = colours_in(
      "# by hand\r\nnewmtl red bone\r\nNs 96\r\nKa 1 1 1\r\n  Kd 1.0 0 "
      "-0.5\r\nnewmtl b\nKd spectral f.rfl\nnewmtl c\nKd xyz 1 1 1\n"
      "newmtl d\nmap_Kd a.png\n");
  EXPECT_EQ(colours, (std::map<std::string, Colour>{{"red bone", {255, 0, 0}}}));
  EXPECT_TRUE(colours_in("").empty());
}

TEST(Mtl, MaterialsAreClaimed) {
  std::string text;
  for (int n = 0; n < 100; ++n) text += "newmtl " + std::to_string(n) + "\nKd 0 0 0\n";
  MemoryBudget budget("a.mtl", {5e-6});
  EXPECT_REFUSED(parse_mtl("a.mtl", text, budget), HasSubstr("for materials"));
}

TEST(Mtl, SaysInWhichLineItIsWrong) {
  for (const char* bad : {"Kd", "Kd 1 1", "Kd 1 x 1", "Kd 1,1,1"}) {
    EXPECT_REFUSED(colours_in(std::string("newmtl a\n") + bad + "\n"),
                   HasSubstr("a.mtl: line 2: expected three numbers after Kd"))
        << bad;
  }
}

}  // namespace
}  // namespace mesamis
