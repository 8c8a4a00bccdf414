// SPDX-License-Identifier: Apache-2.0
#include "mesamis/label_files/label_table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/temp_folder.h"
#include "support/throws.h"

namespace mesamis {
namespace {

using testing::HasSubstr;

std::vector<Segment> read(const std::string& text) {
  const TempFolder folder;
  write_bytes(folder / "a.txt", text);
  return read_label_table(folder / "a.txt");
}

TEST(LabelTable, OfItkSnap) {
  const auto table = read(
      "################\n# ITK-SnAP Label Description File\n################\n"
      "    0     0    0    0        0  0  0    \"Clear Label\"\n"
      "    1   255    0    0        1  1  1    \"left femur\"\r\n"
      "   70     0  128  255      0.5  0  1    \"2\"\n");
  EXPECT_EQ(table,
            (std::vector<Segment>{{"left femur", 1, 0, {255, 0, 0}}, {"2", 70, 0, {0, 128, 255}}}));
}

TEST(LabelTable, OfSlicer) {
  const auto table = read(
      "# Color table file x.ctbl\n# 4 values\n0 Background 0 0 0 0\n9 fat_body 225 230 150 255\n"
      "12 \"left hip\" 230 125 126\n13 bone");
  EXPECT_EQ(table, (std::vector<Segment>{{"fat_body", 9, 0, {225, 230, 150}},
                                         {"left hip", 12, 0, {230, 125, 126}},
                                         {"bone", 13, 0, default_colour(13)}}));
}

TEST(LabelTable, OfAnAtlasWhoseNumbersAreAboveAllLabels) {
  const auto table = read("997 1 2 3 1 1 1 \"root\"\n614454277 4 5 6 1 1 1 \"ventricle\"\n");
  EXPECT_EQ(table, (std::vector<Segment>{{"root", 997, 0, {1, 2, 3}},
                                         {"ventricle", 0, 0, {4, 5, 6}, 614454277}}));
}

TEST(LabelTable, RefusesOtherLines) {
  EXPECT_REFUSED(read("1 a\nliver\n"), HasSubstr("line 2: expected IDX R G B A VIS MSH"));
  EXPECT_REFUSED(read("-1 a 1 2 3\n"), HasSubstr("found \"-1 a 1 2 3\""));
  EXPECT_REFUSED(read("9007199254740992 a 1 2 3\n"), HasSubstr("a whole IDX from 0"));
  EXPECT_REFUSED(read("614454277 a\n614454277 b\n"), HasSubstr("found 614454277 again"));
  EXPECT_REFUSED(read("1 a 1 2 256\n"), HasSubstr("line 1"));
  EXPECT_REFUSED(read("1 a 1 2\n"), HasSubstr("line 1"));
  EXPECT_REFUSED(read("1 a b 1 2 3 4 5 6\n"), HasSubstr("line 1"));
  EXPECT_REFUSED(read("1 1 2 3 1 1 1 \"open\n"), HasSubstr("line 1"));
  EXPECT_REFUSED(read("1 1 2 3 1 1 1 \"\"\n"), HasSubstr("line 1"));
  EXPECT_REFUSED(read("1 a\n2 b\n1 c\n"), HasSubstr("line 3: expected each label once, found 1"));
  EXPECT_REFUSED(read("# nothing\n"), HasSubstr("expected a table of labels, found none"));
  EXPECT_REFUSED(read(std::string((1 << 24) + 1, '\n')), HasSubstr("at most 16777216 bytes"));
  EXPECT_REFUSED(read_label_table("/nowhere/a.label"), HasSubstr("no such file"));
}

TEST(LabelTable, RoundTripsAsItkSnapsOwn) {
  const TempFolder folder;
  const std::vector<Segment> segments{{"left femur", 3, 0, {1, 2, 3}},
                                      {"hip", 65535, 1, {255, 0, 9}}};
  write_label_table(folder / "a.label", segments);
  auto back = read_label_table(folder / "a.label");
  ASSERT_EQ(back.size(), 2u);
  back[1].layer = 1;  // a table has none
  EXPECT_EQ(back, segments);
  EXPECT_THAT(read_bytes(folder / "a.label"), HasSubstr("3 1 2 3 1 1 1 \"left femur\"\n"));
  const std::vector<Segment> odd{{"a \"b\"\nc", 1, 0, {}}};
  write_label_table(folder / "b.label", odd);
  EXPECT_EQ(read_label_table(folder / "b.label")[0].name, "a 'b'?c");
}

TEST(LabelTable, OfLabelsThatComeTwiceIsNotWritten) {
  const TempFolder folder;
  const std::vector<Segment> twice{{"a", 1, 0, {}}, {"b", 1, 1, {}}};
  EXPECT_REFUSED(write_label_table(folder / "a.label", twice), HasSubstr("once, found 1"));
  const std::vector<Segment> zero{{"a", 0, 0, {}}};
  EXPECT_REFUSED(write_label_table(folder / "a.label", zero), HasSubstr("found 0"));
  EXPECT_EQ(folder.file_count(), 0);
}

}  // namespace
}  // namespace mesamis
