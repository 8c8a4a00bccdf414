// SPDX-License-Identifier: Apache-2.0
#include "mesamis/method/parameters.h"

#include <gtest/gtest.h>

#include "mesamis/method/prepare.h"
#include "mesamis/method/setting_table.h"
#include "support/ball_volume.h"

namespace mesamis {
namespace {

TEST(Parameters, AsSettingsTheyLeadToTheSameParameters) {
  const Volume volume = make_ball({.size = 24, .radius = 7});
  Settings asked;
  asked.keep_largest = 2;
  asked.gradation = 1.5;
  Parameters first = prepare_image(volume, asked).parameters;
  choose_tolerance(first, 1, 0.05, kErrorsOfDecimation);  // when there is a surface
  const Settings repeated = settings_of(first);
  EXPECT_NO_THROW(require_valid(repeated));
  const Settings again = settings_of(prepare_image(volume, repeated).parameters);
  for (const Setting& setting : setting_table()) {
    EXPECT_EQ(setting.get(again), setting.get(repeated)) << setting.name;
    if (setting.name == "triangles" || setting.name == "accuracy") continue;
    EXPECT_NE(origin_of(setting, repeated), Origin::kMeasured) << setting.name;
  }
}

TEST(Parameters, ABandHasNoLevelToRepeat) {
  Parameters band;
  band.surface = SurfaceKind::kBand;
  band.level = 7;
  EXPECT_EQ(settings_of(band).level, std::nullopt);
}

TEST(DefaultGamma, IsAPriceOfGreyValuesSquared) {
  const double one = default_gamma(1e-3, 2, 100, 5);
  EXPECT_NEAR(default_gamma(1e-3, 2, 300, 15), 9 * one, 1e-12);
  EXPECT_NEAR(default_gamma(1e-3, 4, 100, 5), 2 * one, 1e-12);
  EXPECT_GT(default_gamma(1e-3, 2, 100, 10), one);
}

TEST(CellsForSurface, GrowWithTheEdges) {
  EXPECT_EQ(cells_for_surface(50'000, 0, {1, 1, 1}), 225'000);
  // The same surface in voxels half as wide, and in slices four times as thick.
  EXPECT_EQ(cells_for_surface(12'500, 0, {0.5, 0.5, 0.5}), 225'000);
  EXPECT_EQ(cells_for_surface(50'000, 0, {1, 1, 4}), 225'000);
  EXPECT_NEAR(cells_for_surface(50'000, 0, {0.1, 0.1, 8}), 225'000, 1e-6);
  // Thin walls and gaps take four times as many.
  EXPECT_EQ(cells_for_surface(50'000, 1, {1, 1, 1}), 900'000);
  EXPECT_EQ(cells_for_surface(50'000, 0.5, {1, 1, 1}), 562'500);
  // The distance asked for: half of the usual one takes twice the cells.
  EXPECT_EQ(cells_for_surface(50'000, 0, {1, 1, 1}, 0.05), 450'000);
  EXPECT_EQ(cells_for_surface(50'000, 0, {1, 1, 1}, 0.2), 112'500);
  EXPECT_EQ(cells_for_surface(50'000, 0, {1, 1, 1}, 1e-6), 900'000);
  EXPECT_NEAR(cells_for_surface(50'000, 0, {2, 2, 2}, 0.2), 56'250, 1e-6) << "as usual";
}

TEST(DefaultStride, ThinsTheGridsOfLargeVolumes) {
  using Stride = std::array<Index, 3>;
  EXPECT_EQ(default_stride({100, 100, 100}, {1, 1, 1}), (Stride{1, 1, 1}));
  EXPECT_EQ(default_stride({101, 100, 100}, {1, 1, 1}), (Stride{2, 2, 2}));
  EXPECT_EQ(default_stride({256, 256, 108}, {0.957, 0.957, 1.5}), (Stride{2, 2, 1}));
  EXPECT_EQ(default_stride({256, 108, 256}, {0.3, 5, 0.3}), (Stride{2, 1, 2}));
  EXPECT_EQ(default_stride({200, 200, 200}, {0.0333333, 0.0333334, 0.0333333}), (Stride{2, 2, 2}));
}

TEST(PreviewStride, HasAtMostThreeMillionNodes) {
  using Sizes = std::array<Index, 3>;
  EXPECT_EQ(preview_stride({100, 100, 100}, {1, 1, 1}), (Sizes{1, 1, 1}));
  EXPECT_EQ(preview_stride({204, 244, 304}, {1, 1, 1}), (Sizes{2, 2, 2}));
  // Where slices are thick, only within them.
  EXPECT_EQ(preview_stride({512, 512, 40}, {0.5, 0.5, 5}), (Sizes{2, 2, 1}));
  for (const Index n : {150, 300, 1000}) {
    const auto [x, y, z] = preview_stride({n, n, 2 * n}, {0.4, 0.5, 0.7});
    EXPECT_LE(2.0 * n * n * n / x / y / z, 3e6) << n;
  }
}

TEST(StrideOf, IsTheGivenOneOrThatOfTheRun) {
  const std::array<Index, 3> voxels{500, 500, 500};
  const Vec3 spacing{1, 1, 1};
  Settings settings;
  EXPECT_EQ(stride_of(settings, voxels, spacing), default_stride(voxels, spacing));
  settings.preview = true;
  EXPECT_EQ(stride_of(settings, voxels, spacing), preview_stride(voxels, spacing));
  EXPECT_NE(preview_stride(voxels, spacing), default_stride(voxels, spacing));
  settings.stride = {3, 1, 2};
  EXPECT_EQ(stride_of(settings, voxels, spacing), *settings.stride);
}

TEST(CellsForSurface, OfPartsAddUp) {
  const auto cells = [](double area) { return cells_for_surface(area, 0.3, {0.5, 0.5, 2}, 0.05); };
  EXPECT_NEAR(cells(10'000) + cells(2'500), cells(12'500), 1e-6);
  EXPECT_EQ(cells(0), 0);
}

}  // namespace
}  // namespace mesamis
