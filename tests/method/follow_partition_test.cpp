// SPDX-License-Identifier: Apache-2.0
#include "mesamis/method/follow_partition.h"

#include <gtest/gtest.h>

#include <cmath>

#include "mesamis/surface/grid_partition.h"
#include "mesamis/surface/smooth_memberships.h"
#include "support/ball_volume.h"
#include "support/label_grids.h"
#include "support/partition_laws.h"

namespace mesamis {
namespace {

constexpr double kRadius = 11;
const Vec3 kCenter{19.5, 19.5, 19.5};

/// The two halves of a ball, label by label; their labels are those of a smaller ball.
OwnedLabels halves(double radius) {
  return labels_where({40, 40, 40}, {1, 1, 1}, [radius](const Vec3& p) {
    return norm(p - kCenter) > radius ? 0 : p.x < kCenter.x ? 1 : 2;
  });
}

double mean_misfit(const PartitionSurface& partition, double radius) {
  double sum = 0;
  int count = 0;
  for (std::size_t t = 0; t < partition.triangles.size(); ++t) {
    const auto& sides = partition.sides[t];
    if (sides[0] != 0 || sides[1] == kNoIndex) continue;  // between the halves, the box
    for (const Index p : partition.triangles[t]) {
      sum += std::abs(norm(partition.points[p] - kCenter) - radius);
      ++count;
    }
  }
  return sum / count;
}

TEST(FollowPartition, ComesToTheLevelSetAndStaysClosed) {
  const OwnedLabels labels = halves(kRadius - 0.6);
  const SplineImage image = interpolating_spline(make_ball({.noise = 2, .radius = kRadius}));
  PartitionSurface partition = extract_partition_on_grid(smooth_memberships(labels.grid()));
  const double seen = middle_radius(kRadius, 1);
  EXPECT_GT(mean_misfit(partition, seen), 0.4);
  const auto pairs = measure_pair_levels(partition, image);
  const auto guides = guides_of_points(partition, pairs, 2);
  partition = follow_image(std::move(partition), image, guides, 2);
  EXPECT_LT(mean_misfit(partition, seen), 0.12);
  expect_partition_laws(partition, labels.box_volume(), "followed");
}

TEST(FollowPartition, LeavesABoundaryThatTheImageDoesNotShow) {
  const SplineImage image = interpolating_spline(make_ball({.noise = 2, .radius = kRadius}));
  const OwnedLabels labels = halves(kRadius);
  PartitionSurface partition = extract_partition_on_grid(smooth_memberships(labels.grid()));
  const auto pairs = measure_pair_levels(partition, image);
  ASSERT_EQ(pairs.size(), 3U);
  EXPECT_FALSE(shows_edge(pairs[2], 2));
  EXPECT_TRUE(shows_edge(pairs[0], 2));
  const auto guides = guides_of_points(partition, pairs, 2);
  partition = follow_image(std::move(partition), image, guides, 2);
  for (std::size_t t = 0; t < partition.triangles.size(); ++t) {
    if (partition.sides[t][0] == 0) continue;
    for (const Index p : partition.triangles[t]) {
      EXPECT_NEAR(partition.points[p].x, 19.5, 0.3) << "where the labels have it";
    }
  }
}

TEST(FollowPartition, OnlyChosenKeepsObjectsAndTurnsTheirGuides) {
  const SplineImage image = interpolating_spline(make_ball({.noise = 2, .radius = kRadius}));
  const OwnedLabels labels = halves(kRadius);
  const PartitionSurface all = extract_partition_on_grid(smooth_memberships(labels.grid()));
  auto guides = guides_of_points(all, measure_pair_levels(all, image), 2);
  const PartitionSurface second = only_chosen(all, {0, 0, 1}, guides);
  EXPECT_EQ(materials_of(second), (std::vector<Index>{0, 2}));
  EXPECT_EQ(guides.size(), second.points.size());
  const SurfaceCheck check = check_surface(object_surface(second, 2));
  EXPECT_EQ(solid_flaws_of(check), "");
  EXPECT_NEAR(check.volume, check_surface(object_surface(all, 2)).volume, 1e-9);
  for (const BoundaryGuide& guide : guides) {
    EXPECT_LE(guide.contrast, 0) << "the background lies behind and is darker";
  }
  // The first object's boundary to the second had it in front; as background it lies behind.
  auto turned = std::vector<BoundaryGuide>(all.points.size(), BoundaryGuide{100, 50});
  const PartitionSurface first = only_chosen(all, {0, 1, 0}, turned);
  int positive = 0, negative = 0;
  for (const BoundaryGuide& guide : turned) (guide.contrast > 0 ? positive : negative) += 1;
  EXPECT_GT(positive, 100) << "to the background";
  EXPECT_GT(negative, 100) << "to the second object";
}

}  // namespace
}  // namespace mesamis
