// SPDX-License-Identifier: Apache-2.0
#include "mesamis/surface/lift_memberships.h"

#include <gtest/gtest.h>

#include "support/label_grids.h"

namespace mesamis {
namespace {

TEST(LiftMemberships, LeavesThickPartsWithFlatBoundaries) {
  const GridMemberships before = filtered(
      labels_where({12, 12, 12}, {1, 1, 1}, [](const Vec3& p) { return p.z > 5.5 ? 1 : 0; }));
  GridMemberships after = before;
  lift_memberships(after);
  EXPECT_EQ(after.value, before.value);
}

TEST(LiftMemberships, LetsASheetOfOneNodeWinByTheSameEverywhere) {
  GridMemberships grid = filtered(
      labels_where({12, 12, 12}, {1, 1, 1}, [](const Vec3& p) { return p.z == 5 ? 1 : 0; }));
  lift_memberships(grid);
  for (std::size_t n = 5 * 144; n < 6 * 144; ++n) {
    const auto begin = static_cast<std::size_t>(grid.first[n]);
    const float others = std::max(grid.value[begin + 1], grid.value[begin + 2]);
    EXPECT_NEAR(grid.value[begin] - others, 0.4, 1e-3);
  }
}

TEST(LiftMemberships, RaisesTheOwnMaterialAlone) {
  const GridMemberships before = filtered(random_blobs(16, 7, 3));
  GridMemberships after = before;
  lift_memberships(after);
  bool has_raised = false;
  for (std::size_t n = 0; n < before.material.size(); ++n) {
    for (auto i = static_cast<std::size_t>(before.first[n]);
         i < static_cast<std::size_t>(before.first[n + 1]); ++i) {
      const float raised = after.value[i] - before.value[i];
      if (before.listed[i] != before.material[n]) {
        EXPECT_EQ(raised, 0);
      }
      EXPECT_GE(raised, 0);
      has_raised = has_raised || raised > 0;
    }
  }
  EXPECT_TRUE(has_raised);
}

}  // namespace
}  // namespace mesamis
