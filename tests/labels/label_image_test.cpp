// SPDX-License-Identifier: Apache-2.0
#include "mesamis/labels/label_image.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "mesamis/base/parallel.h"
#include "mesamis/surface/neighbours.h"
#include "support/label_grids.h"
#include "support/throws.h"

namespace mesamis {
namespace {

VoxelGrid grid_of(const OwnedLabels& labels) {
  return {.size = labels.size, .spacing = labels.spacing};
}

Volume image_of(const OwnedLabels& labels) {
  return label_image(smooth_memberships(labels.grid()), grid_of(labels));
}

/// The numbers themselves: memberships that are certain.
Volume certain_image(const OwnedLabels& labels) {
  GridMemberships grid = filtered(labels);
  for (std::size_t n = 0; n < grid.material.size(); ++n) {
    for (auto i = grid.first[n]; i < grid.first[n + 1]; ++i) {
      grid.value[static_cast<std::size_t>(i)] = i == grid.first[n] ? 1 : 0;
    }
  }
  return label_image(grid, grid_of(labels));
}

TEST(LabelImage, LabelsThatMeetHaveDifferentNumbers) {
  const OwnedLabels labels = random_blobs(22, 12, 5);
  const Volume image = certain_image(labels);
  for (std::size_t n = 0; n < labels.labels.size(); ++n) {
    const Neighbours around(labels.size, static_cast<Index>(n));
    for (std::size_t i = 0; i < 14; ++i) {
      if (around[i] == kNoIndex) continue;
      const auto m = static_cast<std::size_t>(around[i]);
      EXPECT_EQ(labels.labels[n] == labels.labels[m] || image.samples[n] != image.samples[m], true);
    }
  }
}

TEST(LabelImage, OneLabelHasOneNumberEverywhere) {
  const OwnedLabels labels = random_blobs(22, 12, 5);
  const Volume image = certain_image(labels);
  std::vector<float> number(20, -1);
  for (std::size_t n = 0; n < labels.labels.size(); ++n) {
    float& known = number[labels.labels[n]];
    if (known < 0) known = image.samples[n];
    EXPECT_EQ(image.samples[n], known);
  }
  EXPECT_EQ(number[0], 0) << "the background";
  EXPECT_LE(*std::max_element(number.begin(), number.end()), 6) << "few numbers are enough";
}

TEST(LabelImage, LiesBetweenTheNumbersOfTheLabelsAround) {
  const Volume image = image_of(
      labels_where({16, 8, 8}, {1, 1, 1}, [](const Vec3& p) { return p.x > 7.5 ? 4 : 0; }));
  const auto at = [&](Index i) { return image.samples[image.offset(i, 4, 4)]; };
  EXPECT_EQ(at(0), 0);
  EXPECT_EQ(at(15), 1);
  EXPECT_GT(at(8), at(7));
  EXPECT_NEAR(at(7) + at(8), 1, 1e-3) << "the boundary is half way";
}

TEST(LabelImage, IsTheSameForAnyNumberOfThreads) {
  const OwnedLabels labels = random_blobs(20, 7, 2);
  const auto one = with_threads(1, [&] { return image_of(labels); });
  const auto two = with_threads(2, [&] { return image_of(labels); });
  EXPECT_EQ(one.samples, two.samples);
}

TEST(LabelImage, NeedsOneVoxelPerNode) {
  const OwnedLabels labels = random_blobs(8, 2, 1);
  EXPECT_REFUSED(label_image(smooth_memberships(labels.grid()), {.size = {8, 8, 7}}),
                 ::testing::HasSubstr("expected one voxel per node"));
}

}  // namespace
}  // namespace mesamis
