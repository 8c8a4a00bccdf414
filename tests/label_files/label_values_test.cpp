// SPDX-License-Identifier: Apache-2.0
#include "mesamis/label_files/label_values.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "support/throws.h"

namespace mesamis::detail {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

const VoxelGrid kPair{{2, 1, 1}};

TEST(LabelValues, LayersFollowOneAnotherOrLieVoxelByVoxel) {
  const std::vector<float> samples{0, 1, 2, 3, 4, 65535};
  EXPECT_THAT(label_layers("f", kPair, {.inner = 3}, samples),
              ElementsAre(ElementsAre(0, 3), ElementsAre(1, 4), ElementsAre(2, 65535)));
  EXPECT_THAT(label_layers("f", kPair, {.outer = 3}, samples),
              ElementsAre(ElementsAre(0, 1), ElementsAre(2, 3), ElementsAre(4, 65535)));
}

TEST(LabelValues, RefusesWhatIsNoLabel) {
  const auto refused = [](float sample, const char* why) {
    EXPECT_REFUSED(label_layers("f", kPair, {}, {0, sample}), HasSubstr(why));
  };
  refused(-1, "f: expected labels, whole numbers of 0 to 65535, found -1 at voxel 1 0 0");
  refused(0.5f, "found 0.5");
  refused(65536, "found 65536");
  refused(1e20f, "found 1e+20");
  refused(std::numeric_limits<float>::quiet_NaN(), "found nan");
  refused(std::numeric_limits<float>::infinity(), "found inf");
}

TEST(LabelValues, ProbabilitiesAreFromZeroToOne) {
  EXPECT_THAT(probability_layers("f", kPair, {}, {-0.0005f, 1.0005f}),
              ElementsAre(ElementsAre(0, 1)));
  EXPECT_THAT(probability_layers("f", kPair, {.inner = 2}, {0, 0.25f, 0.5f, 1}),
              ElementsAre(ElementsAre(0, 0.5f), ElementsAre(0.25f, 1)));
  for (const float sample : {1.1f, -0.1f, std::numeric_limits<float>::quiet_NaN()}) {
    EXPECT_REFUSED(probability_layers("f", kPair, {}, {0, sample}),
                   HasSubstr("probabilities of 0 to 1"));
  }
}

TEST(LabelValues, ReadsLabels) {
  EXPECT_EQ(label_in(" 12 "), 12);
  EXPECT_EQ(label_in("65535"), 65535);
  for (const char* text : {"", "-1", "65536", "1.5", "1x", "99999999999999999999"}) {
    EXPECT_EQ(label_in(text), std::nullopt) << text;
  }
}

TEST(LabelValues, ColoursSurviveTheirText) {
  for (int c = 0; c < 256; ++c) {
    const std::string share = colour_share(static_cast<std::uint8_t>(c));
    const auto colour = colour_in({share, "0", "1"});
    ASSERT_TRUE(colour);
    EXPECT_THAT(*colour, ElementsAre(c, 0, 255));
  }
  EXPECT_EQ(colour_in({"1.1", "0", "0"}), std::nullopt);
  EXPECT_EQ(colour_in({"0", "", "0"}), std::nullopt);
  EXPECT_EQ(colour_in({"0", "nan", "0"}), std::nullopt);
}

}  // namespace
}  // namespace mesamis::detail
