// SPDX-License-Identifier: Apache-2.0
#include "mesamis/labels/pair_levels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "mesamis/surface/grid_partition.h"
#include "mesamis/surface/smooth_memberships.h"
#include "support/label_grids.h"

namespace mesamis {
namespace {

constexpr Index kSide = 20;

/// Three materials: a half of label 1, and of the rest one half of label 2.
OwnedLabels three() {
  return labels_where({kSide, kSide, kSide}, {1, 1, 1}, [](const Vec3& p) {
    return p.x < 9.5 ? 1 : p.y < 9.5 ? 2 : 0;
  });
}

/// An image of these labels with a value each, edges two voxels wide.
SplineImage image_of(double first, double second, double background) {
  Volume volume{{.size = {kSide, kSide, kSide}}, {}};
  for (Index k = 0; k < kSide; ++k) {
    for (Index j = 0; j < kSide; ++j) {
      for (Index i = 0; i < kSide; ++i) {
        const double in_second = std::clamp((9.5 - j) / 2 + 0.5, 0.0, 1.0);
        const double in_first = std::clamp((9.5 - i) / 2 + 0.5, 0.0, 1.0);
        const double rest = in_second * second + (1 - in_second) * background;
        volume.samples.push_back(static_cast<float>(in_first * first + (1 - in_first) * rest));
      }
    }
  }
  return interpolating_spline(std::move(volume));
}

PartitionSurface partition() {
  const OwnedLabels labels = three();
  return extract_partition_on_grid(smooth_memberships(labels.grid()));
}

TEST(PairLevels, AreHalfWayBetweenBothSides) {
  const auto pairs = measure_pair_levels(partition(), image_of(200, 120, 40));
  ASSERT_EQ(pairs.size(), 3U);
  EXPECT_EQ(pairs[0].sides, (std::array<Index, 2>{0, 1}));
  EXPECT_EQ(pairs[1].sides, (std::array<Index, 2>{0, 2}));
  EXPECT_EQ(pairs[2].sides, (std::array<Index, 2>{1, 2}));
  EXPECT_NEAR(pairs[0].level, 120, 2);
  EXPECT_NEAR(pairs[0].contrast, -160, 4) << "the background is darker";
  EXPECT_NEAR(pairs[1].level, 80, 2);
  EXPECT_NEAR(pairs[2].level, 160, 2);
  EXPECT_NEAR(pairs[2].contrast, 80, 4);
}

TEST(PairLevels, SeeTheSkinOfABone) {
  // Behind the first two voxels the object is as dark as its background.
  SplineImage image = image_of(200, 40, 40);
  Volume volume{{.size = {kSide, kSide, kSide}}, {}};
  for (Index n = 0; n < kSide * kSide * kSide; ++n) {
    const double x = n % kSide;
    volume.samples.push_back(x < 6 ? 50.0F : x < 9.5 ? 200.0F : 40.0F);
  }
  const auto pairs = measure_pair_levels(partition(), interpolating_spline(std::move(volume)));
  EXPECT_NEAR(pairs[0].level, 120, 12);
}

TEST(PairLevels, LeaveOutWhereSeveralMeet) {
  const PartitionSurface surface = partition();
  const auto pairs = measure_pair_levels(surface, image_of(200, 120, 40));
  const auto pair_of = pairs_of_points(surface, pairs);
  std::size_t on_curve = 0;
  for (std::size_t p = 0; p < pair_of.size(); ++p) {
    const Vec3& at = surface.points[p];
    if (std::min({at.x, at.y, at.z}) < 0.5 || std::max({at.x, at.y, at.z}) > 18.5) continue;
    const double away = std::hypot(at.x - 9.5, at.y - 9.5);
    if (away > 2) {
      EXPECT_NE(pair_of[p], kNoIndex) << "between two of them";
    }
    on_curve += away < 1 && pair_of[p] == kNoIndex ? 1 : 0;
  }
  EXPECT_GE(on_curve, 18U) << "one per layer of voxels at least";
}

}  // namespace
}  // namespace mesamis
