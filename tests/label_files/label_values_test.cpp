// SPDX-License-Identifier: Apache-2.0
#include "mesamis/label_files/label_values.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "support/throws.h"

namespace mesamis {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

const VoxelGrid kPair{{2, 1, 1}};

LabelMap labels_of(const LayerOrder& order, const std::vector<double>& samples,
                   std::vector<std::string>& warnings, std::vector<Segment> segments = {}) {
  LabelMap map;
  static_cast<VoxelGrid&>(map) = kPair;
  map.segments = std::move(segments);
  MemoryBudget budget("f", {});
  LabelBuilder builder("f", kPair, order, budget);
  for (const double sample : samples) builder.add(std::span(&sample, 1));
  map = builder.finish(std::move(map), warnings);
  EXPECT_NO_THROW(require_valid(map));
  return map;
}

std::vector<std::vector<std::uint16_t>> layers_of(const LayerOrder& order,
                                                  const std::vector<double>& samples) {
  std::vector<std::string> warnings;
  const LabelMap map = labels_of(order, samples, warnings);
  EXPECT_THAT(warnings, IsEmpty());
  return map.layers;
}

TEST(LabelValues, LayersFollowOneAnotherOrLieVoxelByVoxel) {
  const std::vector<double> samples{0, 1, 2, 3, 4, 65535};
  EXPECT_THAT(layers_of({.inner = 3}, samples),
              ElementsAre(ElementsAre(0, 3), ElementsAre(1, 4), ElementsAre(2, 65535)));
  EXPECT_THAT(layers_of({.outer = 3}, samples),
              ElementsAre(ElementsAre(0, 1), ElementsAre(2, 3), ElementsAre(4, 65535)));
}

TEST(LabelValues, RefusesWhatIsNoLabel) {
  const auto refused = [](double sample, const char* why) {
    std::vector<std::string> warnings;
    EXPECT_REFUSED(labels_of({}, {0, sample}, warnings), HasSubstr(why));
  };
  refused(-1,
          "f: expected labels, whole numbers of 0 to 9007199254740991, found -1 at voxel 1 0 0");
  refused(0.5, "found 0.5");
  refused(2.98, "found 2.98");
  refused(1e20, "found 1e+20");
  refused(std::numeric_limits<double>::infinity(), "found inf");
}

TEST(LabelValues, NumbersThatSinglePrecisionMayHaveRoundedAreRefused) {
  MemoryBudget budget("f", {});
  LabelBuilder builder("f", kPair, {}, budget);
  const std::vector<float> samples{16777215, 16777216};
  EXPECT_REFUSED(builder.add(samples), HasSubstr("0 to 16777215, found 1.67772e+07"));
}

TEST(LabelValues, NearlyWholeOnesAreRoundedAndNanIsBackground) {
  std::vector<std::string> warnings;
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  const LabelMap map = labels_of({.outer = 3}, {3.00005, 2.9999, -1e-4, 1, kNan, 0}, warnings);
  EXPECT_THAT(map.layers, ElementsAre(ElementsAre(3, 3), ElementsAre(0, 1), ElementsAre(0, 0)));
  EXPECT_THAT(warnings, ElementsAre(HasSubstr("3 values are nearly whole, the first 3.00005 at "
                                              "voxel 0 0 0"),
                                    HasSubstr("1 values are not a number")));
}

TEST(LabelValues, NumbersOfAnAtlasGetLabelsAndKeepTheirNames) {
  std::vector<std::string> warnings;
  // As single precision the two large ones are equal.
  const LabelMap map = labels_of({.outer = 3}, {312782546, 5, 0, 312782550, 65535, 5}, warnings,
                                 {{"liver", 1, 0, {}}, {"root", 0, 0, {1, 2, 3}, 312782550}});
  EXPECT_THAT(map.layers, ElementsAre(ElementsAre(2, 5), ElementsAre(0, 3), ElementsAre(65535, 5)));
  EXPECT_THAT(warnings, ElementsAre(AllOf(HasSubstr("2 labels are above 65535"),
                                          HasSubstr("312782546 becomes 2"))));
  EXPECT_EQ(find_segment(map.segments, "312782546").name, "label 312782546");
  EXPECT_EQ(find_segment(map.segments, "312782550"), (Segment{"root", 3, 1, {1, 2, 3}, 312782550}));
  EXPECT_EQ(find_segment(map.segments, "liver").label, 1);
}

TEST(LabelValues, NumbersThatFileAndTablesHave) {
  Segment segment;
  EXPECT_TRUE(set_number(segment, " 65535 "));
  EXPECT_EQ(segment, (Segment{"", 65535}));
  EXPECT_TRUE(set_number(segment, "65536"));
  EXPECT_EQ(segment, (Segment{"", 0, 0, {}, 65536}));
  EXPECT_FALSE(set_number(segment, "9007199254740992"));
  EXPECT_FALSE(set_number(segment, "-1"));
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
}  // namespace mesamis
