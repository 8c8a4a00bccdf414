// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "mesamis/image/label_map.h"
#include "support/throws.h"

namespace mesamis {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

const std::vector<Segment> kFew{{"femur_left", 3, 0, {}}, {"femur_right", 4, 0, {}},
                                {"Liver", 5, 0, {}},      {"liver", 6, 1, {}},
                                {"12", 9, 0, {}},         {"rib", 12, 0, {}}};

std::vector<Segment> many() {
  std::vector<Segment> segments;
  for (const std::string side : {"left", "right"}) {
    for (int n = 1; n <= 12; ++n) {
      segments.push_back({"rib_" + side + "_" + std::to_string(n),
                          static_cast<Index>(segments.size() + 1),
                          0,
                          {}});
    }
  }
  segments.push_back({"sacrum", 30, 0, {}});
  return segments;
}

TEST(FindSegment, GoesByNameOrLabel) {
  EXPECT_EQ(find_segment(kFew, "femur_left"), kFew[0]);
  EXPECT_EQ(find_segment(kFew, "4"), kFew[1]);
  EXPECT_EQ(find_segment(kFew, "liver"), kFew[3]);
  EXPECT_EQ(find_segment(kFew, "Liver"), kFew[2]);
  EXPECT_EQ(find_segment(kFew, "FEMUR_Right"), kFew[1]);
}

TEST(FindSegment, RefusesWhatMayMeanSeveral) {
  EXPECT_REFUSED(find_segment(kFew, "LIVER"), HasSubstr("found 2: \"Liver\" (5), \"liver\" (6)"));
  EXPECT_REFUSED(find_segment(kFew, "12"), HasSubstr("found 2: \"12\" (9), \"rib\" (12)"));
}

TEST(FindSegment, NamesWhatThereIs) {
  EXPECT_REFUSED(find_segment(kFew, "spleen"),
                 AllOf(HasSubstr("found \"spleen\""), HasSubstr("\"femur_left\" (3), \"femur_r")));
  EXPECT_REFUSED(find_segment(kFew, "7"), HasSubstr("found \"7\""));
  EXPECT_REFUSED(find_segment(kFew, ""), HasSubstr("found \"\""));
  EXPECT_REFUSED(find_segment({}, "spleen"), HasSubstr("there are none"));
}

TEST(FindSegment, NamesTheNearestOfMany) {
  EXPECT_REFUSED(find_segment(many(), "sacrem"),
                 HasSubstr("the nearest of 25 are \"sacrum\" (30)"));
  EXPECT_REFUSED(find_segment(many(), "right_12"),
                 HasSubstr("the nearest of 25 are \"rib_right_12\" (24)"));
}

TEST(FindSegment, MessagesStayOneLineOfPlainText) {
  const std::vector<Segment> odd{{"two\nlines\x1b[31m", 1, 0, {}},
                                 {std::string(500, 'x'), 2, 0, {}}};
  EXPECT_REFUSED(find_segment(odd, "Wirbelkörper"), HasSubstr("found \"Wirbelkörper\";"));
  EXPECT_REFUSED(find_segment(odd, "a\nb"), AllOf(HasSubstr("\"a?b\""), HasSubstr("two?lines?[31m"),
                                                  Not(HasSubstr(std::string(61, 'x')))));
}

}  // namespace
}  // namespace mesamis
