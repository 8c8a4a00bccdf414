// SPDX-License-Identifier: Apache-2.0
#include "mesamis/picture/svg.h"

#include <gtest/gtest.h>

#include "mesamis/files/xml.h"
#include "support/wide_budget.h"

namespace mesamis {
namespace {

TEST(SvgNumber, HasTwoDecimalsAndNoNeedlessZeros) {
  EXPECT_EQ(svg_number(0), "0");
  EXPECT_EQ(svg_number(100), "100");
  EXPECT_EQ(svg_number(12.5), "12.5");
  EXPECT_EQ(svg_number(-1.239), "-1.24");
  EXPECT_EQ(svg_number(-0.001), "0");
}

TEST(SvgElement, ReadsBackAsItWasMade) {
  SvgElement child("text");
  child.set("x", 1.5).set_text("a < b & \"c\"");
  SvgElement parent("g");
  parent.set("class", "a\"b<c").add(child).add(SvgElement("line"));
  const std::string text = parent.to_string();
  WideBudget budget;
  const XmlElement read = parse_xml("svg", text, budget).root;
  EXPECT_EQ(read.name, "g");
  EXPECT_EQ(read.attribute("class"), "a\"b<c");
  ASSERT_EQ(read.children.size(), 2u);
  EXPECT_EQ(read.children[0].attribute("x"), "1.5");
  EXPECT_EQ(read.children[0].text, "a < b & \"c\"");
  EXPECT_EQ(read.children[1].name, "line");
}

}  // namespace
}  // namespace mesamis
