// SPDX-License-Identifier: Apache-2.0
#include "mesamis/method/prepare.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/ball_volume.h"
#include "support/throws.h"

namespace mesamis {
namespace {

using testing::HasSubstr;

TEST(FirstGridSize, KeepsTwoNodesAtLeast) {
  EXPECT_EQ(first_grid_size({9, 10, 3}, {2, 3, 100}), (std::array<Index, 3>{5, 4, 2}));
}

TEST(PrepareImage, WhatIsGivenIsNotMeasured) {
  Settings settings;
  settings.window = Window{100, 250};
  settings.noise = 6;
  settings.blur = {0.5, 0, 0};
  settings.gamma = 0.3;
  settings.max_tets = 5000;
  settings.level = 160;
  settings.min_volume = 2;
  settings.tolerance = 0.25;
  settings.h_max = 4;
  settings.eta = 1e-4;
  const Parameters p = prepare_image(make_ball({.size = 24, .radius = 7}), settings).parameters;
  EXPECT_EQ(p.grey.low, 100);
  EXPECT_EQ(p.grey.high, 250);
  EXPECT_EQ(p.noise, 6);
  EXPECT_EQ(p.blur, (std::array<double, 3>{0.5, 0, 0}));
  EXPECT_EQ(p.functional.gamma, 0.3);
  EXPECT_EQ(p.functional.eta, 1e-4);
  EXPECT_EQ(p.max_tets, 5000);
  EXPECT_EQ(p.level, 160);
  EXPECT_EQ(p.min_volume, 2);
  EXPECT_EQ(p.tolerance, 0.25);
  EXPECT_EQ(p.h_max, 4);
}

TEST(PrepareImage, MeasuresWhatIsLeftOpen) {
  const Prepared prepared =
      prepare_image(make_ball({.size = 32, .noise = 8, .radius = 9}), Settings{});
  const Parameters& p = prepared.parameters;
  EXPECT_NEAR(p.noise, 8, 2);
  EXPECT_NEAR(p.level, 175, 8);
  EXPECT_EQ(p.unit_mm, 1);
  EXPECT_EQ(p.functional.eta, 1e-6);
  EXPECT_EQ(p.h_max, 31.0 / 4);
  EXPECT_EQ(p.min_volume, 4);
  EXPECT_FALSE(p.tolerance) << "it follows from the surface";
  EXPECT_GE(p.max_tets, kFewestTets);
  EXPECT_GT(p.functional.gamma, 0);
  EXPECT_FALSE(p.grey.has_threshold()) << "two classes need no T";
}

TEST(PrepareImage, LengthsFollowTheUnit) {
  BallVolume fine{.size = 24, .radius = 7 * 0.2};
  fine.spacing = {0.2, 0.2, 0.2};
  fine.blur = 0.2;
  const Volume volume = make_ball(fine);
  EXPECT_NEAR(prepare_image(volume, Settings{}).parameters.unit_mm, 0.2, 1e-12);
  Settings mm;
  mm.length_unit = LengthUnit::kMm;
  EXPECT_EQ(prepare_image(volume, mm).parameters.unit_mm, 1);
}

TEST(PrepareImage, WithoutRestoringTheImageIsTheOneThatCame) {
  const Volume volume = make_ball({.size = 24, .noise = 5, .radius = 7});
  Settings settings;
  settings.restore = false;
  settings.window = Window{0, 255};
  settings.threshold_rule = ThresholdRule::kNone;
  const Prepared prepared = prepare_image(volume, settings);
  EXPECT_EQ(prepared.grey.samples, volume.samples);
  EXPECT_EQ(prepared.measured.impulses, 0);
  EXPECT_NEAR(prepared.parameters.noise, 5, 1.5) << "the noise is measured all the same";
  EXPECT_EQ(prepared.parameters.blur, (std::array<double, 3>{}));
}

TEST(PrepareImage, ThePapersThresholdIsAGreyValue) {
  Settings settings;
  settings.threshold_rule = ThresholdRule::kPaper;
  settings.window = Window{100, 355};
  const Prepared prepared =
      prepare_image(make_ball({.size = 24, .object = 350, .radius = 7}), settings);
  EXPECT_EQ(prepared.parameters.grey.threshold, 240);
  for (const float grey : prepared.grey.samples) EXPECT_GE(grey, 140);
}

TEST(PrepareImage, ALevelBelowTheThresholdMovesAboveIt) {
  const Volume ball = make_ball({.size = 32, .radius = 9});
  Settings settings;
  settings.threshold_rule = ThresholdRule::kValue;
  settings.threshold = 190;  // above the half maximum of 175
  EXPECT_NEAR(prepare_image(ball, settings).parameters.level, (190 + 230) / 2.0, 5);
  settings.threshold = 140;
  EXPECT_NEAR(prepare_image(ball, settings).parameters.level, 175, 5);
}

TEST(PrepareImage, RefusesSettingsThatLeaveNothingToSee) {
  const Volume volume = make_ball({.size = 24, .radius = 7});
  Settings settings;
  settings.window = Window{900, 990};
  EXPECT_REFUSED(
      prepare_image(volume, settings),
      HasSubstr(
          "window: expected a range that contains samples, which lie between 900 and 900, found"));
  settings.window = Window{100, 250};
  settings.window = Window{100, 180};
  settings.level = 200;
  EXPECT_REFUSED(prepare_image(volume, settings),
                 HasSubstr("level: expected a value between the window's ends"));
}

TEST(PrepareImage, RefusesALevelBesideTheDataAndTellsTheirRange) {
  Volume volume = make_ball({.size = 24, .radius = 7});
  for (float& sample : volume.samples) sample = std::clamp(std::round(sample), 120.0F, 230.0F);
  Settings settings;
  for (const double level : {-5000.0, 120.0, 230.0, 5000.0}) {
    settings.level = level;
    EXPECT_REFUSED(prepare_image(volume, settings),
                   testing::AllOf(HasSubstr("the data, 120 to 230, found "),
                                  HasSubstr(std::to_string(static_cast<int>(level)))));
  }
  settings.surface = SurfaceKind::kBand;
  EXPECT_NO_THROW(prepare_image(volume, settings)) << "a band has no level";
}

TEST(PrepareImage, RefusesNoiseAloneUnlessALevelIsGiven) {
  const Volume noise = make_ball({.size = 40, .object = 120, .noise = 15, .seed = 5});
  Settings settings;
  EXPECT_REFUSED(prepare_image(noise, settings), HasSubstr("stands out from the noise"));
  settings.level = 130;
  EXPECT_NO_THROW(prepare_image(noise, settings));
  settings.level.reset();
  settings.surface = SurfaceKind::kBand;
  EXPECT_NO_THROW(prepare_image(noise, settings)) << "a band has no level";
}

/// Slices [begin, end) of a volume.
Volume slices_of(const Volume& volume, Index begin, Index end) {
  CropRange range;
  range.begin[2] = begin;
  range.end[2] = end;
  return crop(volume, range);
}

TEST(PrepareSlab, IsAPieceOfThePreparedWholeAwayFromItsEnds) {
  for (const bool impulses : {false, true}) {
    Volume scan = make_ball({.size = 56, .noise = 6, .radius = 16});
    for (std::size_t n = 0; impulses && n < scan.samples.size(); n += 97) {
      scan.samples[n] = n % 2 == 0 ? 0 : 255;
    }
    const Prepared whole = prepare_image(scan, Settings{});
    const Chosen choice = choose_from_part(scan, scan, Settings{}).chosen;
    EXPECT_EQ(choice.impulse_height > 0, impulses);
    const Index begin = 10, end = 50, outer = 12;
    const Prepared slab = prepare_slab(slices_of(scan, begin, end), {}, choice);
    EXPECT_EQ(slab.parameters.level, whole.parameters.level);
    float grey = 0, spline = 0;
    const std::size_t slice = scan.offset(0, 0, 1);
    for (std::size_t n = outer * slice; n < (end - begin - outer) * slice; ++n) {
      const std::size_t at = n + begin * slice;
      grey = std::max(grey, std::abs(slab.grey.samples[n] - whole.grey.samples[at]));
      spline =
          std::max(spline, std::abs(slab.image.coefficients[n] - whole.image.coefficients[at]));
    }
    EXPECT_LT(grey, 0.05) << "grey values, of 255; impulses: " << impulses;
    EXPECT_LT(spline, 0.05) << impulses;
  }
}

TEST(PrepareSlab, WithoutRestoringItIsAPieceToTheBit) {
  const Volume scan = make_ball({.size = 30, .noise = 6, .radius = 9});
  Settings settings;
  settings.restore = false;
  const Prepared whole = prepare_image(scan, settings);
  const Prepared slab =
      prepare_slab(slices_of(scan, 5, 25), {}, choose_from_part(scan, scan, settings).chosen);
  EXPECT_EQ(slab.grey.samples, slices_of(whole.grey, 5, 25).samples);
}

TEST(CellsOf, OfSlabsAddUp) {
  const Volume scan = make_ball({.size = 40, .noise = 4, .radius = 11});
  const Prepared whole = prepare_image(scan, Settings{});
  const double cells = cells_of(whole);
  EXPECT_NEAR(cells / (4.5 * 4 * 3.14159265 * 11 * 11), 1, 0.05);
  double sum = 0;
  for (const auto& [begin, end] : {std::pair{0, 19}, {18, 40}}) {  // they share a slice
    sum += cells_of({whole.parameters, whole.measured, slices_of(whole.grey, begin, end), {}});
  }
  EXPECT_GE(sum, cells);
  EXPECT_LT(sum / cells, 1.05) << "edges within the common slice count twice";
}

}  // namespace
}  // namespace mesamis
