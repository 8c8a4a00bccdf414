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
      EXPECT_EQ(before.samples[n]<level, after.samples[n]> mirrored(level));
    }
  }
}

TEST(Mirrored, WindowsStayInOrder) {
  const Window window = mirrored(Window{-200, 800});
  EXPECT_EQ(window.low, -800);
  EXPECT_EQ(window.high, 200);
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
