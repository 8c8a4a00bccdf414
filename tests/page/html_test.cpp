// SPDX-License-Identifier: Apache-2.0
#include "mesamis/page/html.h"

#include <gmock/gmock.h>

namespace mesamis {
namespace {

TEST(HtmlEscaped, LeavesNothingThatMeansSomething) {
  EXPECT_EQ(html_escaped("<script>alert('x')</script>"),
            "&lt;script&gt;alert(&#39;x&#39;)&lt;/script&gt;");
  EXPECT_EQ(html_escaped("a & b \"c\""), "a &amp; b &quot;c&quot;");
  EXPECT_EQ(html_escaped("Weiß, 骨"), "Weiß, 骨") << "letters stay";
  EXPECT_EQ(html_escaped("a\x1b[2Jb\nc\xff"), "a?[2Jb?c?");
}

TEST(Html, EscapesWhatItContains) {
  Html p("p");
  p.set("title", "\"><img src=x onerror=alert(1)>").text("1 < 2");
  EXPECT_EQ(p.str(), "<p title=\"&quot;&gt;&lt;img src=x onerror=alert(1)&gt;\">1 &lt; 2</p>");
}

TEST(Html, ClosesEveryElementInItsWay) {
  EXPECT_EQ(Html("input").flag("checked").str(), "<input checked>");
  EXPECT_EQ(Html("path").set("d", "M0 0").str(), "<path d=\"M0 0\"/>");
  EXPECT_EQ(Html("td").str(), "<td></td>");
  EXPECT_EQ(Html().add(element("b", "x")).str(), "<b>x</b>") << "no element around";
  EXPECT_TRUE(Html("ul").is_empty());
  EXPECT_EQ(of_class("p", "hint").str(), "<p class=\"hint\"></p>");
}

}  // namespace
}  // namespace mesamis
