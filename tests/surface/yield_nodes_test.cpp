// SPDX-License-Identifier: Apache-2.0
#include "mesamis/surface/yield_nodes.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "support/label_grids.h"

namespace mesamis {
namespace {

struct Yielded {
  OwnedLabels after;
  std::int64_t count = 0, parts_before = 0, parts_after = 0;
};

Yielded yielded(const OwnedLabels& labels) {
  GridMemberships grid = filtered(labels);
  Yielded result{.after = labels, .parts_before = std::ssize(grid.label)};
  result.count = yield_nodes(grid);
  for (std::size_t n = 0; n < grid.material.size(); ++n) {
    result.after.labels[n] =
        static_cast<std::uint16_t>(grid.label[static_cast<std::size_t>(grid.material[n])]);
  }
  result.parts_after = std::ssize(find_label_parts(result.after.grid()).label);
  return result;
}

TEST(YieldNodes, TakesASingleStepOffAPlane) {
  OwnedLabels labels =
      labels_where({14, 14, 14}, {1, 1, 1}, [](const Vec3& p) { return p.z > 6.5 ? 1 : 0; });
  const OwnedLabels plane = labels;
  labels.at(7, 7, 6) = 1;
  const Yielded result = yielded(labels);
  EXPECT_EQ(result.count, 1);
  EXPECT_EQ(result.after.labels, plane.labels);
}

TEST(YieldNodes, LeavesPlanesSheetsLinesAndTheirEnds) {
  OwnedLabels labels =
      labels_where({20, 20, 20}, {1, 1, 1}, [](const Vec3& p) { return p.z > 14.5 ? 1 : 0; });
  for (Index i = 2; i < 17; ++i) {
    for (Index j = 2; j < 17; ++j) labels.at(i, j, 4) = 2;
  }
  for (Index i = 2; i < 17; ++i) labels.at(i, 9, 9) = 3;
  const Yielded result = yielded(labels);
  EXPECT_EQ(result.count, 0);
}

TEST(YieldNodes, KeepsTheNumberOfParts) {
  for (const unsigned one_in : {3U, 10U, 50U}) {
    OwnedLabels labels = random_blobs(24, 5, one_in);
    std::mt19937 generator(one_in);
    for (std::uint16_t& label : labels.labels) {
      if (generator() % one_in == 0) label = static_cast<std::uint16_t>(generator() % 6);
    }
    const Yielded result = yielded(labels);
    EXPECT_GT(result.count, 0) << one_in;
    EXPECT_EQ(result.parts_after, result.parts_before) << one_in;
  }
}

}  // namespace
}  // namespace mesamis
