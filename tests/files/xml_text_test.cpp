// SPDX-License-Identifier: Apache-2.0
// That a reader finds the text again: xml_test.cpp.
#include "mesamis/files/xml_text.h"

#include <gtest/gtest.h>

namespace mesamis {
namespace {

TEST(XmlText, LeavesNothingThatMeansSomething) {
  EXPECT_EQ(xml_escaped("<a b=\"c\"> & 'd'"), "&lt;a b=&quot;c&quot;&gt; &amp; 'd'");
  EXPECT_EQ(xml_escaped("line\n\x01\xff"), "line\n??");
  EXPECT_EQ(xml_escaped(""), "");
}

}  // namespace
}  // namespace mesamis
