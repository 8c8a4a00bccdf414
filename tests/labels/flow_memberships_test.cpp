// SPDX-License-Identifier: Apache-2.0
#include "mesamis/labels/flow_memberships.h"

#include <gtest/gtest.h>

#include "mesamis/base/parallel.h"
#include "mesamis/labels/label_confidence.h"
#include "support/label_grids.h"
#include "support/partition_laws.h"
#include "support/throws.h"

namespace mesamis {
namespace {

constexpr double kMargin = 4;

GridMemberships flow(const OwnedLabels& labels, const std::vector<float>& edges) {
  const GridMemberships smooth = smooth_memberships(labels.grid());
  const auto weight = label_confidence(labels.grid(), kMargin);
  return flow_memberships(labels.grid(), {smooth, weight, edges}, {.reach = 2 * kMargin});
}

OwnedLabels half_space(double from) {
  return labels_where({24, 7, 7}, {1, 1, 1}, [from](const Vec3& p) { return p.x >= from ? 1 : 0; });
}

/// An image with one edge, the plane at x = `at`, as wide as a voxel to both sides.
std::vector<float> edge_at(const OwnedLabels& labels, double at) {
  std::vector<float> v(labels.labels.size(), 1);
  for (std::size_t n = 0; n < v.size(); ++n) {
    const double x = static_cast<double>(n % static_cast<std::size_t>(labels.size[0]));
    if (std::abs(x - at) < 1) v[n] = 0.02F;
  }
  return v;
}

/// How many nodes of the middle row have the label 1.
int of_label(const GridMemberships& found) {
  int count = 0;
  for (Index i = 0; i < found.size[0]; ++i) {
    const auto n = static_cast<std::size_t>(i + found.size[0] * (3 + found.size[1] * 3));
    count += found.label[static_cast<std::size_t>(found.material[n])] == 1 ? 1 : 0;
  }
  return count;
}

TEST(FlowMemberships, StaysAtTheLabelsWhereTheImageShowsNothing) {
  const OwnedLabels labels = half_space(12);
  EXPECT_EQ(of_label(flow(labels, std::vector<float>(labels.labels.size(), 1))), 12);
}

TEST(FlowMemberships, ComesToTheEdgeFromBothSides) {
  for (const double label_from : {9.0, 10.0, 12.0, 14.0, 15.0}) {
    const OwnedLabels labels = half_space(label_from);
    EXPECT_EQ(of_label(flow(labels, edge_at(labels, 11.5))), 12) << label_from;
  }
}

TEST(FlowMemberships, GoesNoFurtherThanTheMargin) {
  const OwnedLabels labels = half_space(4);
  EXPECT_LE(std::abs(of_label(flow(labels, edge_at(labels, 16.5))) - 20), kMargin);
}

TEST(FlowMemberships, ReportsHowItsSystemsWereSolved) {
  const OwnedLabels labels = half_space(12);
  const GridMemberships smooth = smooth_memberships(labels.grid());
  const auto weight = label_confidence(labels.grid(), kMargin);
  const auto edges = edge_at(labels, 11.5);
  const auto report_with = [&](double tolerance) {
    FlowReport report;
    flow_memberships(labels.grid(), {smooth, weight, edges},
                     {.reach = 2 * kMargin, .tolerance = tolerance}, &report);
    return report;
  };
  const FlowReport coarse = report_with(1e-3), fine = report_with(1e-9),
                   never = report_with(1e-300);
  EXPECT_TRUE(coarse.solver_converged && fine.solver_converged);
  EXPECT_LE(fine.solver_residual, 2e-9);
  EXPECT_LE(coarse.solver_residual, 2e-3);
  EXPECT_GT(fine.solver_iterations, coarse.solver_iterations);
  EXPECT_FALSE(never.solver_converged);
}

TEST(FlowMemberships, KeepsAVoxelAlone) {
  OwnedLabels labels = labels_where({11, 11, 11}, {1, 1, 1}, [](const Vec3&) { return 0; });
  labels.at(5, 5, 5) = 9;
  const GridMemberships found = flow(labels, std::vector<float>(labels.labels.size(), 1));
  EXPECT_EQ(found.label[static_cast<std::size_t>(found.material[5 + 11 * (5 + 11 * 5)])], 9);
}

TEST(FlowMemberships, AreSharesAndTheWinnerHasTheLargest) {
  const OwnedLabels labels = random_blobs(26, 9, 2);
  const GridMemberships found = flow(labels, edge_at(labels, 12.5));
  for (std::size_t n = 0; n < found.material.size(); ++n) {
    const auto begin = static_cast<std::size_t>(found.first[n]);
    for (std::size_t i = begin; i < static_cast<std::size_t>(found.first[n + 1]); ++i) {
      EXPECT_GE(found.value[i], 0);
      EXPECT_LE(found.value[i], found.value[begin]) << "the node's own material comes first";
      EXPECT_LE(found.value[i], 1);
    }
    if (found.first[n] != found.first[n + 1]) {
      EXPECT_EQ(found.listed[begin], found.material[n]);
    }
  }
}

TEST(FlowMemberships, MakeClosedObjectsThatShareTheirBoundaries) {
  for (unsigned seed = 1; seed <= 3; ++seed) {
    const OwnedLabels labels = random_blobs(24, 8, seed);
    const GridMemberships found = flow(labels, edge_at(labels, 11.5));
    expect_partition_laws(extract_partition_on_grid(found), labels.box_volume(),
                          "seed " + std::to_string(seed));
  }
}

TEST(FlowMemberships, AreTheSameForAnyNumberOfThreads) {
  const OwnedLabels labels = random_blobs(24, 8, 4);
  const auto edges = edge_at(labels, 10.5);
  const auto one = with_threads(1, [&] { return flow(labels, edges); });
  const auto two = with_threads(2, [&] { return flow(labels, edges); });
  EXPECT_EQ(one.material, two.material);
  EXPECT_EQ(one.value, two.value);
}

TEST(FlowMemberships, RefuseWhatDoesNotFit) {
  const OwnedLabels labels = half_space(12);
  const auto smooth = smooth_memberships(labels.grid());
  const auto weight = label_confidence(labels.grid(), kMargin);
  const std::vector<float> edges(labels.labels.size(), 1), few(3, 1);
  EXPECT_REFUSED(flow_memberships(labels.grid(), {smooth, weight, few}, {}),
                 ::testing::HasSubstr("labels, weights and edges"));
  EXPECT_REFUSED(flow_memberships(labels.grid(), {smooth, weight, edges}, {.reach = 0}),
                 ::testing::HasSubstr("reach"));
  EXPECT_REFUSED(flow_memberships(labels.grid(), {{}, weight, edges}, {}),
                 ::testing::HasSubstr("smooth_memberships()"));
}

}  // namespace
}  // namespace mesamis
