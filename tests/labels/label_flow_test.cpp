// SPDX-License-Identifier: Apache-2.0
#include "mesamis/labels/label_flow.h"

#include <gtest/gtest.h>

#include <cmath>

#include "mesamis/labels/label_confidence.h"
#include "support/label_grids.h"

namespace mesamis {
namespace {

constexpr std::size_t kLength = 30;

/// What a flow reads, of labels that are open everywhere; all is the same along j and k.
struct Case {
  OwnedLabels labels;
  GridMemberships smooth;
  std::vector<float> weight, edges;

  Case(OwnedLabels from, float confidence)
      : labels(std::move(from)),
        smooth(smooth_memberships(labels.grid())),
        weight(labels.labels.size(), confidence),
        edges(labels.labels.size(), 1) {}

  /// Along the first row.
  std::vector<double> solve(std::uint16_t label, const LabelExtent& extent,
                            const FlowOptions& options) const {
    const LabelGrid grid = labels.grid();
    const FlowFields fields{smooth, weight, edges};
    const LabelMembership found = LabelFlow(grid, fields, options).solve(label, extent);
    std::vector<double> first(kLength, 0);
    for (std::size_t n = 0; n < found.nodes.size(); ++n) {
      if (found.nodes[n] < kLength) first[found.nodes[n]] = found.value[n];
    }
    return first;
  }
};

constexpr FlowOptions kFar{.beta = 2, .eta = 0, .unit_mm = 1, .reach = 60, .tolerance = 1e-10};
constexpr LabelExtent kBelow{{0, 0, 0}, {14, 1, 1}}, kAbove{{15, 0, 0}, {29, 1, 1}};

OwnedLabels row() {
  return labels_where({kLength, 2, 2}, {1, 1, 1}, [](const Vec3& p) { return p.x > 14.5 ? 1 : 0; });
}

TEST(LabelFlow, LeavesOneInAll) {
  const Case c(row(), 0.1F);
  const auto p = c.solve(1, kAbove, kFar), q = c.solve(0, kBelow, kFar);
  for (std::size_t n = 0; n < p.size(); ++n) EXPECT_NEAR(p[n] + q[n], 1, 1e-4) << n;
}

TEST(LabelFlow, SolvesTheEquationOfTheFunctional) {
  Case c(row(), 0.1F);
  for (std::size_t n = 0; n < c.edges.size(); ++n) {
    c.edges[n] = 0.3F + 0.02F * static_cast<float>(n % kLength);
  }
  const auto p = c.solve(1, kAbove, kFar);
  const auto conductance = [&](std::size_t a, std::size_t b) {
    return kFar.beta * (c.edges[a] * c.edges[a] + c.edges[b] * c.edges[b]) / 2;
  };
  // Where p is not cut off at the least that is kept.
  for (std::size_t n = 10; n + 1 < p.size(); ++n) {
    const double rest = c.weight[n] * (p[n] - smooth_membership(c.smooth, n, 1)) +
                        conductance(n, n - 1) * (p[n] - p[n - 1]) +
                        conductance(n, n + 1) * (p[n] - p[n + 1]);
    EXPECT_NEAR(rest, 0, 1e-6) << n;
  }
}

TEST(LabelFlow, GoesNoFurtherThanItsReach) {
  FlowOptions options = kFar;
  options.reach = 3;
  const auto p = Case(row(), 0.001F).solve(1, kAbove, options);
  EXPECT_GT(p[12], 0);
  for (std::size_t n = 0; n < 12; ++n) EXPECT_EQ(p[n], 0) << n;
}

TEST(LabelFlow, StopsAtWhatIsCertain) {
  Case c(row(), 0.001F);
  for (std::size_t n = 12; n < c.weight.size(); n += kLength) c.weight[n] = kCertain;
  const auto p = c.solve(1, kAbove, kFar);
  EXPECT_GT(p[13], 0);
  for (std::size_t n = 0; n <= 12; ++n) EXPECT_EQ(p[n], 0) << n;
}

}  // namespace
}  // namespace mesamis
