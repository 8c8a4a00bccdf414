// SPDX-License-Identifier: Apache-2.0
#include "mesamis/surface/smooth_memberships.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>

#include "mesamis/base/parallel.h"
#include "mesamis/surface/box_tree.h"
#include "support/label_grids.h"
#include "support/partition_laws.h"
#include "support/throws.h"

namespace mesamis {
namespace {

/// The surfaces of labels, whose laws are tested: volumes to 1 %, nothing intersects, closed.
PartitionSurface expect_label_laws(const OwnedLabels& labels, const std::string& what) {
  SmoothReport report;
  const PartitionSurface partition =
      extract_partition_on_grid(smooth_memberships(labels.grid(), {}, &report));
  EXPECT_LE(report.volume_error, 0.01) << what;
  expect_partition_laws(partition, labels.box_volume(), what);
  for (const Index label : materials_of(partition)) {
    const double wanted = labels.volume_of(static_cast<std::uint16_t>(label));
    EXPECT_NEAR(check_surface(object_surface(partition, label)).volume, wanted, 0.01 * wanted)
        << what << ", label " << label;
  }
  return partition;
}

std::int64_t parts_of(const PartitionSurface& partition, Index label) {
  return check_surface(object_surface(partition, label)).components;
}

TEST(SmoothMemberships, KeepTheLawsForBlobs) {
  for (unsigned seed = 1; seed <= 4; ++seed) {
    const OwnedLabels labels = random_blobs(28, 9, seed);
    expect_label_laws(labels, "seed " + std::to_string(seed));
  }
}

/// One in so many nodes gets another label.
OwnedLabels with_wrong_nodes(OwnedLabels labels, int kinds, unsigned one_in) {
  std::mt19937 generator(7);
  for (std::uint16_t& label : labels.labels) {
    if (generator() % one_in == 0)
      label = static_cast<std::uint16_t>(generator() % unsigned(kinds));
  }
  return labels;
}

TEST(SmoothMemberships, LosesNoPartOfNoise) {
  const OwnedLabels labels = with_wrong_nodes(random_blobs(20, 5, 3), 6, 10);
  SmoothReport report;
  const PartitionSurface partition =
      extract_partition_on_grid(smooth_memberships(labels.grid(), {}, &report));
  expect_partition_laws(partition, labels.box_volume(), "noise");
  // A part may have cavities, whose walls are components too: each is another part's skin.
  std::int64_t components = 0;
  for (const Index label : materials_of(partition)) components += parts_of(partition, label);
  EXPECT_GE(components, report.parts);
  for (std::uint16_t label = 0; label < 6; ++label) {
    EXPECT_EQ(std::ranges::count(materials_of(partition), Index{label}), 1);
  }
}

TEST(SmoothMemberships, KeepsPartsOfOneVoxel) {
  OwnedLabels labels = labels_where({15, 15, 15}, {1, 1, 1}, [](const Vec3&) { return 0; });
  labels.at(3, 3, 3) = 1;                                 // a voxel,
  labels.at(3, 3, 6) = 1;                                 // another one,
  labels.at(4, 4, 4) = 1;                                 // which joins the first at a corner,
  for (Index i = 3; i < 12; ++i) labels.at(i, 8, 4) = 2;  // a line,
  for (Index i = 3; i < 12; ++i) {
    for (Index j = 3; j < 12; ++j) labels.at(i, j, 10) = 3;  // and a sheet
  }
  const PartitionSurface partition = expect_label_laws(labels, "one voxel");
  EXPECT_EQ(parts_of(partition, 1), 2);
  EXPECT_EQ(parts_of(partition, 2), 1);
  EXPECT_EQ(parts_of(partition, 3), 1);
}

struct Distances {
  double sum = 0, area = 0, worst = 0, angle = 0;
  double mean() const { return sum / area; }
  double mean_angle_deg() const { return angle / area * 180 / std::numbers::pi; }
};

/// How far triangles with label 1 on one side are from where a function of unit gradient is 0, by
/// area.
template <class Function, class Gradient>
Distances distances(const PartitionSurface& partition, Function f, Gradient gradient,
                    const Box& within) {
  Distances d;
  for (std::size_t t = 0; t < partition.triangles.size(); ++t) {
    if (partition.sides[t][1] == kNoIndex) continue;
    const auto [i, j, k] = partition.triangles[t];
    const Vec3 a = partition.points[i], b = partition.points[j], c = partition.points[k];
    const Vec3 center = (1.0 / 3) * (a + b + c), normal = cross(b - a, c - a);
    if (!overlap(within, Box{center, center})) continue;
    const double area = 0.5 * norm(normal);
    d.area += area;
    d.sum += area * std::abs(f(center));
    d.worst = std::max(d.worst, std::abs(f(center)));
    const double cosine = std::abs(dot(normal, gradient(center))) / (2 * area);
    d.angle += area * std::acos(std::min(1.0, cosine));
  }
  return d;
}

TEST(SmoothMemberships, TakesTheStairsOffAPlane) {
  const Vec3 middle{15.2, 14.9, 15.1};
  const Box within{{4, 4, 4}, {26, 26, 26}};
  for (Vec3 normal : {Vec3{1, 0.4, 0.2}, Vec3{0.3, 1, -0.7}, Vec3{1, 1, 1}, Vec3{1, -1, 0},
                      Vec3{0.1, 0.05, 1}, Vec3{-0.6, 0.8, 1}, Vec3{0, 0.25, 1}}) {
    normal = (1 / norm(normal)) * normal;
    const auto side = [&](const Vec3& p) { return dot(p - middle, normal); };
    const OwnedLabels labels =
        labels_where({31, 31, 31}, {1, 1, 1}, [&](const Vec3& p) { return side(p) > 0 ? 1 : 0; });
    const PartitionSurface partition = extract_partition_on_grid(smooth_memberships(labels.grid()));
    const Distances d = distances(
        partition, side, [&](const Vec3&) { return normal; }, within);
    EXPECT_LT(d.worst, 0.3);
    EXPECT_LT(d.mean_angle_deg(), 8);
  }
}

TEST(SmoothMemberships, AreNearABallOfCoarseVoxels) {
  for (const double radius : {3.0, 5.0, 8.0}) {
    const Vec3 middle{10.3, 9.8, 10.1};
    const auto depth = [&](const Vec3& p) { return radius - norm(p - middle); };
    const OwnedLabels labels =
        labels_where({21, 21, 21}, {1, 1, 1}, [&](const Vec3& p) { return depth(p) > 0 ? 1 : 0; });
    const PartitionSurface partition = expect_label_laws(labels, "ball");
    const Distances d = distances(
        partition, depth, [&](const Vec3& p) { return (1 / norm(p - middle)) * (p - middle); },
        {{0, 0, 0}, {20, 20, 20}});
    EXPECT_LT(d.mean(), 0.15) << radius;
    EXPECT_LT(d.worst, 0.6) << radius;
  }
}

TEST(SmoothMemberships, AreNearTwoBallsThatTouch) {
  const Vec3 a{9.1, 10.2, 10.3}, b{18.8, 10.4, 9.9};
  const double radius = 6;
  const auto at = [&](const Vec3& p) {
    return std::array{radius - norm(p - a), radius - norm(p - b)};
  };
  const OwnedLabels labels = labels_where({29, 21, 21}, {1, 1, 1}, [&](const Vec3& p) {
    const auto [in_a, in_b] = at(p);
    return std::max(in_a, in_b) < 0 ? 0 : in_a > in_b ? 1 : 2;
  });
  const PartitionSurface partition = expect_label_laws(labels, "balls");
  double sum = 0, area = 0;
  for (std::size_t t = 0; t < partition.triangles.size(); ++t) {
    const auto [behind, before] = partition.sides[t];
    if (before == kNoIndex) continue;
    const auto [i, j, k] = partition.triangles[t];
    const Vec3 p = partition.points[i], q = partition.points[j], r = partition.points[k];
    const auto [in_a, in_b] = at((1.0 / 3) * (p + q + r));
    const double off = behind == 1 ? 0.5 * (in_a - in_b) : before == 1 ? in_a : in_b;
    const double size = 0.5 * norm(cross(q - p, r - p));
    sum += size * std::abs(off);
    area += size;
  }
  EXPECT_LT(sum / area, 0.15);
}

TEST(SmoothMemberships, FollowTheSpacing) {
  const OwnedLabels one = random_blobs(16, 4, 2);
  OwnedLabels other = one;
  other.spacing = {0.5, 2, 4};
  const auto plain = extract_partition_on_grid(smooth_memberships(one.grid(), {.most_rounds = 0}));
  const auto wide = extract_partition_on_grid(smooth_memberships(other.grid(), {.most_rounds = 0}));
  EXPECT_EQ(plain.triangles.size(), wide.triangles.size());
  ASSERT_EQ(plain.points.size(), wide.points.size());
  for (std::size_t p = 0; p < plain.points.size(); ++p) {
    const Vec3& x = plain.points[p];
    EXPECT_LT(norm(wide.points[p] - Vec3{0.5 * x.x, 2 * x.y, 4 * x.z}), 1e-9);
  }
  expect_label_laws(other, "spacing");
}

TEST(SmoothMemberships, HasTheSameBytesForAnyNumberOfThreads) {
  const OwnedLabels labels = random_blobs(40, 12, 5);
  const auto one = with_threads(1, [&] { return smooth_memberships(labels.grid()); });
  const auto two = with_threads(2, [&] { return smooth_memberships(labels.grid()); });
  EXPECT_EQ(one.material, two.material);
  EXPECT_EQ(one.first, two.first);
  EXPECT_EQ(one.listed, two.listed);
  EXPECT_EQ(one.value, two.value);
}

TEST(SmoothMemberships, TakesLabelsOfOneKind) {
  const OwnedLabels labels = labels_where({4, 3, 2}, {1, 1, 1}, [](const Vec3&) { return 65535; });
  SmoothReport report;
  const auto partition = extract_partition_on_grid(smooth_memberships(labels.grid(), {}, &report));
  EXPECT_EQ(report.parts, 1);
  EXPECT_TRUE(report.converged);
  EXPECT_EQ(materials_of(partition), std::vector<Index>{65535});
}

TEST(SmoothMemberships, TakesAnotherLabelAtEachNode) {
  Index next = 0;
  const OwnedLabels labels =
      labels_where({8, 8, 8}, {1, 1, 1}, [&](const Vec3&) { return next++; });
  SmoothReport report;
  const auto partition = extract_partition_on_grid(smooth_memberships(labels.grid(), {}, &report));
  EXPECT_EQ(report.parts, 512);
  EXPECT_EQ(materials_of(partition).size(), 512u);
  expect_partition_laws(partition, 343, "512 labels");
}

TEST(SmoothMemberships, RefusesWhatDoesNotFit) {
  const OwnedLabels good = random_blobs(4, 2, 1);
  const auto expect_refused = [&](const char* what, const OwnedLabels& labels,
                                  const SmoothOptions& options) {
    EXPECT_REFUSED(smooth_memberships(labels.grid(), options), testing::HasSubstr(what));
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const auto& size : {std::array<Index, 3>{64, 1, 1},
                           {4, 4, 3},
                           {-4, -4, 4},
                           {0, 0, 0},
                           {1 << 22, 1 << 22, 1 << 22}}) {
    OwnedLabels labels = good;
    labels.size = size;
    expect_refused("one per node", labels, {});
  }
  for (const double spacing : {0.0, -1.0, nan, std::numeric_limits<double>::infinity()}) {
    OwnedLabels labels = good;
    labels.spacing.y = spacing;
    expect_refused("spacing", labels, {});
  }
  for (const double sigma : {0.4, 4.1, nan})
    expect_refused("Gaussian", good, {.sigma_voxel = sigma});
  expect_refused("accuracy", good, {.volume_accuracy = 0});
  expect_refused("rounds", good, {.most_rounds = -1});
}

}  // namespace
}  // namespace mesamis
