// SPDX-License-Identifier: Apache-2.0
#include "mesamis/volume_files/dicom_series.h"

#include <gmock/gmock.h>

#include "support/throws.h"

namespace mesamis {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

constexpr bool kAcross = true;

/// One slice of a series; across: a sagittal one.
DicomImage image(const std::string& series, bool across = false) {
  DicomSlice slice;
  slice.file = "folder/" + series + (across ? "_across" : "");
  slice.columns = slice.rows = 4;
  slice.along_row = across ? Vec3{0, 1, 0} : Vec3{1, 0, 0};
  slice.along_column = across ? Vec3{0, 0, -1} : Vec3{0, 1, 0};
  DicomImage image;
  image.series = series;
  image.modality = "CT";
  image.has_pixels = true;
  image.slices = {slice};
  return image;
}

std::vector<DicomImage> images(const std::string& series, int along, int across = 0) {
  std::vector<DicomImage> all(static_cast<std::size_t>(along), image(series));
  all.insert(all.end(), static_cast<std::size_t>(across), image(series, kAcross));
  return all;
}

std::vector<DicomImage> operator+(std::vector<DicomImage> a, const std::vector<DicomImage>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

TEST(DicomSeries, GroupsByUidInTheOrderOfTheFiles) {
  const auto all = group_by_series(images("9", 2) + images("1", 3) + images("9", 1));
  ASSERT_EQ(all.size(), 2u);
  EXPECT_EQ(all[0].uid, "9");
  EXPECT_EQ(all[0].frames, 3u);
  EXPECT_EQ(all[1].uid, "1");
  EXPECT_EQ(all[1].stacks[0].size(), 3u);
  EXPECT_EQ(all[1].modality, "CT");
}

/// Two files of one slice, coded in two ways; a third one is another slice.
TEST(DicomSeries, OfTwoEncodingsThatWithoutLossIsKept) {
  auto all = images("1", 3);
  all[0].instance = all[1].instance = "1.5";
  all[0].file = "lossy.dcm";
  all[0].slices[0].file = "lossy.dcm";
  all[0].transfer_syntax = "1.2.840.10008.1.2.4.50";
  all[0].lossy = true;
  all[1].transfer_syntax = "1.2.840.10008.1.2.1";
  all[2].slices[0].position = {0, 0, 1};
  const auto series = group_by_series(all);
  ASSERT_EQ(series.size(), 1u);
  ASSERT_EQ(series[0].stacks[0].size(), 2u);
  EXPECT_EQ(series[0].stacks[0][0].file, "folder/1");
  EXPECT_THAT(series[0].warnings, ElementsAre(AllOf(HasSubstr("1 file left out: the same slices"),
                                                    HasSubstr("lossy.dcm"))));
  all[1].transfer_syntax = all[0].transfer_syntax;
  all[1].content = 7;
  EXPECT_EQ(group_by_series(all)[0].stacks[0].size(), 3u) << "another picture";
}

TEST(DicomSeries, WarnsWhereSomeSlicesAloneHaveNoRescale) {
  auto all = images("1", 3);
  EXPECT_THAT(group_by_series(all)[0].warnings, IsEmpty()) << "none has one";
  for (std::size_t n : {0, 2}) all[n].slices[0].rescaled = true;
  all[1].slices[0].file = "folder/b.dcm";
  EXPECT_THAT(group_by_series(all)[0].warnings,
              ElementsAre(HasSubstr("1 slice, the first b.dcm, without Rescale Slope")));
}

TEST(DicomSeries, FilesWithoutPixelsAreSkipped) {
  DicomImage report = image("1");
  report.has_pixels = false;
  EXPECT_THAT(group_by_series({report}), IsEmpty());
}

TEST(DicomSeries, ASideStackUpToAQuarterIsALocalizer) {
  const DicomSeries quarter = group_by_series(images("1", 8, 2))[0];
  EXPECT_EQ(quarter.problem, "");
  EXPECT_EQ(quarter.stacks.size(), 1u);
  EXPECT_EQ(quarter.stacks[0].size(), 8u);
  EXPECT_THAT(quarter.warnings, ElementsAre(HasSubstr("2 slices left out")));
  const DicomSeries more = group_by_series(images("1", 8, 3))[0];
  EXPECT_THAT(more.problem, AllOf(HasSubstr("8 slices like 1"), HasSubstr("3 like 1_across"),
                                  HasSubstr("another orientation")));
  EXPECT_EQ(group_by_series(images("1", 2, 1))[0].problem, "") << "a single one always is";
}

TEST(DicomSeries, LocalizersByTheirOwnWordAreLeftOutHoweverMany) {
  auto all = images("1", 3) + images("1", 0, 5);
  for (DicomImage& other : all) {
    other.slices[0].localizer = other.slices[0].along_row.y == 1;
  }
  const DicomSeries series = group_by_series(all)[0];
  EXPECT_EQ(series.problem, "");
  EXPECT_EQ(series.stacks[0].size(), 3u);
}

TEST(DicomSeries, AnotherPixelSpacingIsAnotherStack) {
  auto all = images("1", 4);
  all[3].slices[0].row_step = all[2].slices[0].row_step = 1.01;
  EXPECT_THAT(group_by_series(all)[0].problem, HasSubstr("another size or pixel spacing"));
  all[3].slices[0].row_step = all[2].slices[0].row_step = 1.0005;
  EXPECT_EQ(group_by_series(all)[0].stacks.size(), 1u);
}

TEST(DicomSeries, ABrokenFileIsTheProblemOfItsSeries) {
  DicomImage broken = image("1");
  broken.slices.clear();
  broken.problem = "b.dcm: broken";
  const DicomSeries series = group_by_series(images("1", 3) + std::vector{broken})[0];
  EXPECT_EQ(series.problem, "b.dcm: broken");
  EXPECT_EQ(series.frames, 4u);
}

TEST(DicomSeries, TheOnlyVolumeIsChosenOrTheOneNamed) {
  const auto one_volume = group_by_series(images("1", 1) + images("2", 5));
  EXPECT_EQ(choose_series("scan", one_volume, "").uid, "2");
  EXPECT_EQ(choose_series("scan", one_volume, "1").uid, "1");
  const auto two = group_by_series(images("1", 4) + images("2", 5) + images("3", 1));
  EXPECT_REFUSED(choose_series("scan", two, ""),
                 AllOf(HasSubstr("scan: expected one series of slices, found 2"),
                       HasSubstr("\"1\""), HasSubstr("\"2\""), Not(HasSubstr("\"3\""))));
  EXPECT_REFUSED(choose_series("scan", two, "7"),
                 AllOf(HasSubstr("expected the series \"7\""), HasSubstr("\"3\"")));
  EXPECT_REFUSED(choose_series("scan", {}, ""), HasSubstr("expected DICOM images, found none"));
}

TEST(DicomSeries, AtMostTwentyTitlesAreListed) {
  std::vector<DicomImage> many;
  for (int n = 0; n < 30; ++n) many.push_back(image("uid" + std::to_string(n) + "."));
  const std::string titles = titles_of(group_by_series(many));
  EXPECT_THAT(titles, AllOf(HasSubstr("uid19."), Not(HasSubstr("uid20.")), HasSubstr("and more")));
}

}  // namespace
}  // namespace mesamis
