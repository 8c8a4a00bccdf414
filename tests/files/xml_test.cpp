// SPDX-License-Identifier: Apache-2.0
#include "mesamis/files/xml.h"

#include <gtest/gtest.h>

#include <string>

#include "mesamis/files/xml_text.h"
#include "support/throws.h"

namespace mesamis {
namespace {

using testing::AllOf;
using testing::HasSubstr;

/// Where nothing else is said, a GB is more than enough.
XmlDocument parse_within(const std::string& text, const XmlOptions& options = {},
                         double memory_gb = 1) {
  MemoryBudget budget("a.xml", {memory_gb});
  return parse_xml("a.xml", text, budget, options);
}

XmlElement parse(const std::string& text) { return parse_within(text).root; }

std::string repeated(const std::string& text, std::size_t times) {
  std::string out;
  for (std::size_t i = 0; i < times; ++i) out += text;
  return out;
}

TEST(Xml, GivesElementsAttributesAndText) {
  const XmlElement root = parse(
      "<?xml version=\"1.0\"?>\n<!-- by hand --><a x=\"1\" y='&lt;2&gt;'><b>one</b> two <c/>"
      "<b>&amp;&#65;&quot;</b></a>\n");
  EXPECT_EQ(root.name, "a");
  EXPECT_EQ(root.attribute("x"), "1");
  EXPECT_EQ(root.attribute("y"), "<2>");
  EXPECT_EQ(root.attribute("z"), "");
  ASSERT_EQ(root.children.size(), 3u);
  EXPECT_EQ(root.child("b")->text, "one");
  EXPECT_EQ(root.children[2].text, "&A\"");
  EXPECT_EQ(root.child("none"), nullptr);
}

/// XML 1.0: comments and the marks of CDATA are no part of the text.
TEST(Xml, CommentsAndCdataDoNotCutANumber) {
  for (const char* text : {"<x>10</x>", "<x>1<!--c-->0</x>", "<x><![CDATA[10]]></x>",
                           "<x>1<![CDATA[0]]></x>", "<x>1<?note?>0</x>", "<x>&#49;0</x>"}) {
    EXPECT_EQ(parse(text).text, "10") << text;
  }
}

TEST(Xml, AChildDoesNotJoinTwoNumbers) { EXPECT_EQ(parse("<x>1<b/>0</x>").text, "1 0"); }

TEST(Xml, ReadsOtherEncodingsAsUtf8) {
  EXPECT_EQ(parse("<?xml version=\"1.0\" encoding=\"ISO-8859-1\"?><x>M\xfcller</x>").text,
            "M\xc3\xbcller");
  EXPECT_EQ(parse("\xef\xbb\xbf<x>M\xc3\xbcller</x>").text, "M\xc3\xbcller");
}

TEST(Xml, WhatIsNotWellFormedIsRefusedWithItsLine) {
  for (const std::string text :
       {"", " ", "text", "<a", "<a>", "<a></b>", "<a><b></a>", "<a x></a>", "<a x=1/>", "<a/><b/>",
        "<a x='1' x='2'/>", "<a>&nbsp;</a>", "<a>\x01</a>", "<a>\xff</a>", "<a/>end"}) {
    EXPECT_REFUSED(parse(text), HasSubstr("a.xml: broken XML in line 1")) << text;
  }
  EXPECT_REFUSED(parse("<a>\n<b>\n</a>"), AllOf(HasSubstr("line 3"), HasSubstr("mismatched tag")));
}

TEST(Xml, EntitiesAreNotExpanded) {
  EXPECT_REFUSED(parse("<!DOCTYPE a [<!ENTITY x \"ha\">]><a>&x;</a>"),
                 HasSubstr("expected no declarations of entities"));
  EXPECT_REFUSED(parse("<!DOCTYPE a [<!ENTITY x SYSTEM \"/etc/hostname\">]><a>&x;</a>"),
                 HasSubstr("expected no declarations of entities"));
  std::string laughs = "<!DOCTYPE a [<!ENTITY a0 \"ha\">";
  for (int n = 1; n < 30; ++n) {
    const std::string before = "&a" + std::to_string(n - 1) + ";";
    laughs += "<!ENTITY a" + std::to_string(n) + " \"" + repeated(before, 10) + "\">";
  }
  EXPECT_REFUSED(parse(laughs + "]><a>&a29;</a>"), HasSubstr("declarations of entities"));
}

/// As property lists name theirs. Its entities are unknown: one that vanished would change a
/// number.
TEST(Xml, AnExternalDtdIsNamedButNotRead) {
  const std::string doctype =
      "<!DOCTYPE a PUBLIC \"-//A//DTD 1.0//EN\" \"http://127.0.0.1/a.dtd\">";
  EXPECT_EQ(parse(doctype + "<a>10</a>").text, "10");
  EXPECT_REFUSED(parse(doctype + "<a>1&x;0</a>"), HasSubstr("found \"&x;\""));
  EXPECT_REFUSED(parse(doctype + "<a b=\"1&x;0\"/>"), HasSubstr("found \"&x;\""));
  EXPECT_EQ(parse(doctype + "<a b=\"1&amp;&#48;\"/>").attribute("b"), "1&0");
}

TEST(Xml, DepthIsBounded) {
  EXPECT_NO_THROW(parse(repeated("<a>", 32) + repeated("</a>", 32)));
  EXPECT_REFUSED(parse(repeated("<a>", 33) + repeated("</a>", 33)), HasSubstr("at most 32 elem"));
  EXPECT_REFUSED(parse(repeated("<a>", 1'000'000)), HasSubstr("at most 32 elements"));
}

TEST(Xml, NumbersOfElementsAttributesAndNamesAreBounded) {
  EXPECT_REFUSED(parse("<a>" + repeated("<b/>", 500'000) + "</a>"), HasSubstr("at most 500000"));
  EXPECT_REFUSED(parse("<a>" + repeated("<b c='' d='' e='' f=''/>", 100'000) + "</a>"),
                 HasSubstr("at most 500000"));
  std::string names;
  for (int n = 0; n < 10'000; ++n) names += "<b" + std::to_string(n) + "/>";
  EXPECT_REFUSED(parse("<a>" + names + "</a>"), HasSubstr("at most 10000 different names"));
}

/// Elements cost some fifty times their bytes: they are claimed before they are made.
TEST(Xml, TheTreeIsClaimedAsItGrowsAndHeldAsFarAsItIsKept) {
  const std::string tree = "<a>" + repeated("<b c='1'/>", 100'000) + "</a>";
  MemoryBudget budget("a.xml", {0.1});
  EXPECT_NO_THROW(parse_xml("a.xml", tree, budget));
  EXPECT_GT(budget.held(), 100'000 * sizeof(XmlElement));
  EXPECT_REFUSED(parse_within(tree, {}, 0.01), AllOf(HasSubstr("memory"), HasSubstr("of XML")));
  EXPECT_REFUSED(parse_within("<a>" + std::string(6'000'000, ' ') + "</a>", {}, 0.01),
                 HasSubstr("memory"));
  MemoryBudget small("a.xml", {0.01});
  parse_xml("a.xml", tree, small, {.consume = [](const auto&, auto) { return true; }});
  EXPECT_LT(small.held(), 1000u);
}

TEST(Xml, TagsAndCommentsAreBoundedAndTextIsNot) {
  const std::string long_text(3 << 20, ' ');
  EXPECT_EQ(parse("<a>" + long_text + "</a>").text.size(), long_text.size());
  EXPECT_REFUSED(parse("<a><!--" + long_text + "--></a>"),
                 HasSubstr("a tag or comment of at most"));
  EXPECT_REFUSED(parse("<a b='" + long_text + "'/>"), HasSubstr("a tag or comment of at most"));
}

TEST(Xml, ConsumedElementsAreNotKept) {
  std::size_t count = 0;
  std::string paths;
  const auto consume = [&](const XmlElement& element, std::string_view path) {
    if (path == "a/b/c") return ++count, element.text == "7";
    (paths += path) += ' ';
    return false;
  };
  const std::string text = "<a><b>" + repeated("<c>7</c>", 600'000) + "<d/></b></a>";
  const XmlElement root = parse_within(text, {.consume = consume}).root;
  EXPECT_EQ(count, 600'000u);
  EXPECT_EQ(paths, "a/b/d a/b ");
  EXPECT_EQ(root.child("b")->children.size(), 1u);
}

TEST(Xml, AnErrorOfTheConsumerReachesTheCaller) {
  const auto consume = [](const XmlElement&, std::string_view) -> bool {
    throw InputError("a.xml: no");
  };
  EXPECT_REFUSED(parse_within("<a><b/></a>", {.consume = consume}), HasSubstr("a.xml: no"));
}

TEST(Xml, RawDataEndTheDocument) {
  const std::string raw("\0<&]]>\xff_", 8);
  const std::string text =
      "<V><P>1</P><AppendedData encoding=\"raw\">\n _" + raw + "</AppendedData>";
  const XmlDocument document = parse_within(text, {.ends_at_appended_data = true});
  EXPECT_EQ(document.appended, raw + "</AppendedData>");
  EXPECT_EQ(document.root.child("AppendedData")->attribute("encoding"), "raw");
  EXPECT_EQ(document.root.child("P")->text, "1");
  EXPECT_REFUSED(parse(text), HasSubstr("broken XML"));
  EXPECT_REFUSED(parse_within("<V><AppendedData>", {.ends_at_appended_data = true}),
                 HasSubstr("expected the mark _"));
}

/// The document's bytes are fed in pieces of 64 KiB; raw data may begin anywhere.
TEST(Xml, RawDataAreFoundAcrossPieces) {
  for (std::size_t size = 65'500; size < 65'560; ++size) {
    const std::string text = "<V>" + std::string(size, ' ') + "<AppendedData> _raw";
    ASSERT_EQ(parse_within(text, {.ends_at_appended_data = true}).appended, "raw") << size;
  }
}

TEST(Xml, EscapedTextReadsBackAndIsAlwaysXml) {
  for (const std::string text :
       {"a<b> & \"c\" 'd'", "M\xc3\xbcller \xe2\x82\xac \xf0\x9f\x98\x80"}) {
    EXPECT_EQ(parse("<x>" + xml_escaped(text) + "</x>").text, text);
    EXPECT_EQ(parse("<x y=\"" + xml_escaped(text) + "\"/>").attribute("y"), text);
  }
  // Control, cut off, overlong, surrogate, beyond Unicode, no character.
  for (const std::string bad : {"\x01", "\xe2\x82", "\xc0\xaf", "\xed\xa0\x80", "\xf4\x90\x80\x80",
                                "\xef\xbf\xbf", "\xff"}) {
    const std::string escaped = xml_escaped("a" + bad + "b");
    EXPECT_EQ(escaped, "a" + std::string(bad.size(), '?') + "b");
    EXPECT_NO_THROW(parse("<x>" + escaped + "</x>"));
  }
}

TEST(Xml, UnescapingUndoesEscaping) {
  for (const std::string text : {"", "plain", "a<b> & \"c\" 'd'", "M\xc3\xbcller &amp;"}) {
    EXPECT_EQ(xml_unescaped(xml_escaped(text)), text);
  }
  EXPECT_EQ(xml_unescaped("&#65;&#x42;"), "AB");
  EXPECT_EQ(xml_unescaped("Smith & Sons"), "Smith & Sons");
  EXPECT_EQ(xml_unescaped("&x;"), "&x;");
}

}  // namespace
}  // namespace mesamis
