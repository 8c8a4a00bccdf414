// SPDX-License-Identifier: Apache-2.0
#include "mesamis/surface/part_filter.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/label_grids.h"

namespace mesamis {
namespace {

TEST(PartFilter, IsTheSumOfTheKernelOverAHalfSpace) {
  const double sigma = 1.5;
  const auto labels =
      labels_where({24, 3, 3}, {1, 1, 1}, [](const Vec3& p) { return p.x < 11.5 ? 0 : 1; });
  const GridMemberships grid = filtered(labels, sigma);
  const auto below = [](double x, double s) { return 0.5 * std::erfc(-x / (s * std::sqrt(2.0))); };
  for (const Index i : {11, 12}) {
    const auto begin = static_cast<std::size_t>(grid.first[static_cast<std::size_t>(24 + 72 + i)]);
    // Of continuous Gaussians, from whose sums at whole distances the kernel hardly differs.
    const double x = 0.5, once = below(x, sigma), twice = below(x, sigma * std::sqrt(2.0));
    EXPECT_NEAR(grid.value[begin], 2 * once - twice, 0.01) << i;
    EXPECT_NEAR(grid.value[begin] + grid.value[begin + 1], 1, 1e-5) << i;
  }
}

TEST(PartFilter, MembershipsAddUpToOneWhereAllPartsAreListed) {
  const GridMemberships grid = filtered(
      labels_where({12, 12, 12}, {1, 1, 1}, [](const Vec3& p) { return p.x + p.y > 9 ? 3 : 1; }),
      2);
  for (std::size_t n = 0; n + 1 < grid.first.size(); ++n) {
    const auto begin = static_cast<std::size_t>(grid.first[n]);
    if (grid.first[n] == grid.first[n + 1]) continue;
    EXPECT_NEAR(grid.value[begin] + grid.value[begin + 1], 1, 1e-5);
  }
}

}  // namespace
}  // namespace mesamis
