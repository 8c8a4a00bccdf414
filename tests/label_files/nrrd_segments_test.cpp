// SPDX-License-Identifier: Apache-2.0
#include "mesamis/label_files/nrrd_segments.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/throws.h"

namespace mesamis {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

using Keys = std::map<std::string, std::string>;

TEST(NrrdSegments, AreInTheOrderOfTheirNumbers) {
  Keys keys{{"Segmentation_MasterRepresentation", "Binary labelmap"}, {"Segments", "none"}};
  for (int n = 0; n < 12; ++n) {
    const std::string prefix = "Segment" + std::to_string(n) + "_";
    keys[prefix + "Name"] = "rib " + std::to_string(n);
    keys[prefix + "LabelValue"] = std::to_string(20 - n);
    keys[prefix + "Layer"] = n == 5 ? "1" : "0";
    keys[prefix + "Color"] = "0 1 0.50196078431372548";
  }
  const auto segments = segments_in_keys("f", keys, 2);
  ASSERT_EQ(segments.size(), 12u);
  for (Index n = 0; n < 12; ++n) {
    EXPECT_EQ(segments[static_cast<std::size_t>(n)],
              (Segment{"rib " + std::to_string(n), 20 - n, n == 5 ? 1 : 0, {0, 255, 128}}));
  }
}

TEST(NrrdSegments, OfOlderFilesHaveALayerEach) {
  const Keys keys{{"Segment0_Name", "a"},
                  {"Segment1_ID", "b"},
                  {"Segment2_Extent", "0 1 0 1 0 1"},
                  {"Segment1_DefaultColor", "1 0 0"}};
  const auto segments = segments_in_keys("f", keys, 3);
  ASSERT_EQ(segments.size(), 3u);
  EXPECT_EQ(segments[0], (Segment{"a", 1, 0, default_colour(1)}));
  EXPECT_EQ(segments[1], (Segment{"b", 1, 1, {255, 0, 0}}));
  EXPECT_EQ(segments[2].name, "label 1");
  EXPECT_EQ(segments[2].layer, 2);
  EXPECT_THAT(segments_in_keys("f", {{"Segment_0", "a"}, {"key", "value"}}, 1), IsEmpty());
}

TEST(NrrdSegments, RefusesWhatTheFileCannotHold) {
  const auto refused = [](Keys keys, const char* why) {
    keys["Segment0_Name"] = "a";
    keys["Segment1_Name"] = "b";
    EXPECT_REFUSED(segments_in_keys("f", keys, 2), HasSubstr(why));
  };
  refused({{"Segment0_LabelValue", "0"}}, "LabelValue of 1 to 65535, found \"0\"");
  refused({{"Segment0_LabelValue", "65536"}}, "found \"65536\"");
  refused({{"Segment0_LabelValue", "one"}}, "found \"one\"");
  refused({{"Segment1_Layer", "2"}}, "the layer of segment 1 among 2, found \"2\"");
  refused({{"Segment1_Layer", "-1"}}, "found \"-1\"");
  refused({{"Segment1_Layer", "x"}}, "found \"x\"");
  refused({{"Segment2_Name", "c"}}, "the layer of segment 2 among 2, found 2");
  refused({{"Segment0_LabelValue", "3"}, {"Segment1_LabelValue", "3"}},
          "two for label 3 of layer 0");
}

TEST(NrrdSegments, KeysAreThoseOfSlicerAndReadBack) {
  LabelMap map;
  map.size = {4, 3, 2};
  map.segments = {{"hip joint", 300, 1, {1, 2, 3}}, {"absent", 7, 0, {}}};
  map.layers.assign(2, std::vector<std::uint16_t>(24));
  map.layers[1][map.offset(1, 2, 0)] = 300;
  map.layers[1][map.offset(3, 2, 1)] = 300;
  const auto list = segment_keys(map);
  const Keys keys(list.begin(), list.end());
  EXPECT_EQ(keys.at("Segmentation_MasterRepresentation"), "Binary labelmap");
  EXPECT_EQ(keys.at("Segment0_ID"), "Segment_1");
  EXPECT_EQ(keys.at("Segment0_Name"), "hip joint");
  EXPECT_EQ(keys.at("Segment0_Extent"), "1 3 2 2 0 1");
  EXPECT_EQ(keys.at("Segment0_LabelValue"), "300");
  EXPECT_EQ(keys.at("Segment0_Layer"), "1");
  EXPECT_EQ(keys.at("Segment1_Extent"), "0 -1 0 -1 0 -1");
  EXPECT_EQ(segments_in_keys("f", keys, 2), map.segments);
}

}  // namespace
}  // namespace mesamis
