// SPDX-License-Identifier: Apache-2.0
#include "mesamis/object/mirror.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "support/throws.h"

namespace mesamis {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

Volume row() {
  Volume volume;
  volume.size = {5, 1, 1};
  volume.modality = "CT";
  volume.samples = {-1024, 0, 99.5F, 200, 3000};
  return volume;
}

TEST(Mirrored, TurnsTheSignAndTwiceNothing) {
  EXPECT_THAT(mirrored(row()).samples, ElementsAre(1024, 0, -99.5F, -200, -3000));
  EXPECT_EQ(mirrored(mirrored(row())).samples, row().samples);
}

/// What is darker than a level is brighter than the mirrored one.
TEST(Mirrored, LevelsSplitTheSamplesAsBefore) {
  const Volume before = row(), after = mirrored(row());
  for (const double level : {-500.0, 50.0, 1000.0}) {
    for (std::size_t n = 0; n < before.samples.size(); ++n) {
      EXPECT_EQ(
          before.samples[n]<level, after.samples[n]> ImageUnits(TissueKind::kDark).turned(level));
    }
  }
}

TEST(ImageUnits, KeepWindowsInOrderAndTurnEverythingBack) {
  const ImageUnits dark(TissueKind::kDark);
  const Window window = dark.turned(Window{-200, 800});
  EXPECT_EQ(window.low, -800);
  EXPECT_EQ(window.high, 200);
  for (const GreyMap& map : {GreyMap{-200, 800, 100}, GreyMap{-200, 800, -200}}) {
    const GreyMap once = dark.turned(map), twice = dark.turned(once);
    EXPECT_EQ(once.has_threshold(), map.has_threshold());
    EXPECT_EQ(twice.low, map.low);
    EXPECT_EQ(twice.high, map.high);
    EXPECT_EQ(twice.threshold, map.threshold);
  }
  const Tissue air = dark.turned(parse_tissue("lung"));
  EXPECT_LT(air.levels.low, air.levels.high);
  EXPECT_GT(air.levels.low, 0) << "bright in the mirrored image";
}

TEST(ImageUnits, OfBrightObjectsAndRangesAreTheScans) {
  for (const TissueKind kind : {TissueKind::kBright, TissueKind::kRange}) {
    EXPECT_EQ(ImageUnits(kind).turned(70), 70);
    EXPECT_EQ(ImageUnits(kind).turned(Window{-200, 800}).low, -200);
  }
}

TEST(WithinRange, IsPositiveBetweenTheTwoValuesAlone) {
  EXPECT_THAT(within_range(row(), {0, 200}).samples, ElementsAre(-1024, 0, 99.5F, 0, -2800));
}

TEST(WithinRange, RefusesAnEmptyRange) {
  EXPECT_REFUSED(within_range(row(), {200, 200}), HasSubstr("range: expected low below high"));
  EXPECT_REFUSED(within_range(row(), {0, std::nan("")}), HasSubstr("range"));
}

}  // namespace
}  // namespace mesamis
