// SPDX-License-Identifier: Apache-2.0
#include "mesamis/surface/select_parts.h"

#include <gtest/gtest.h>

#include "support/throws.h"
#include "surface/nested_cubes.h"

namespace mesamis {
namespace {

using ::testing::HasSubstr;

double volume_of(const TriMesh& surface) { return check_surface(surface).volume; }

TEST(SelectParts, KeepsAllByDefaultAndCounts) {
  SelectionReport report;
  const TriMesh all = select_parts(nested(), {}, &report);
  EXPECT_EQ(all.triangles, nested().triangles);
  EXPECT_EQ(all.points, nested().points);
  EXPECT_EQ(report.islands, 4);
  EXPECT_EQ(report.cavities, 2);
  EXPECT_EQ(report.islands_dropped + report.cavities_filled, 0);
}

TEST(SelectParts, DropsSmallIslandsAndFillsSmallCavities) {
  SelectionReport report;
  const TriMesh kept = select_parts(nested(), {.volume_min = 2}, &report);
  EXPECT_NEAR(volume_of(kept), 1000 - 216 + 27 + 8, 1e-9);
  EXPECT_EQ(report.islands_dropped, 1);
  EXPECT_NEAR(report.volume_dropped, 0.125, 1e-12);
  EXPECT_EQ(report.cavities_filled, 1);
  EXPECT_NEAR(report.volume_filled, 1, 1e-12);
}

TEST(SelectParts, TheLargestStaysIfAskedTo) {
  constexpr double kMore = 5000;  // than any part has
  EXPECT_TRUE(select_parts(nested(), {.volume_min = kMore}).triangles.empty());
  const TriMesh kept = select_parts(nested(), {.volume_min = kMore, .largest_stays = true});
  EXPECT_NEAR(volume_of(kept), 1000, 1e-9);
  EXPECT_TRUE(select_parts({}, {.largest_stays = true}).triangles.empty());
}

TEST(SelectParts, AFilledCavityTakesAlongWhatItHolds) {
  SelectionReport report;
  const TriMesh kept = select_parts(nested(), {.fill_cavities = true}, &report);
  EXPECT_NEAR(volume_of(kept), 1000 + 27 + 0.125, 1e-9);
  EXPECT_EQ(report.cavities_filled, 1) << "the other one leaves with its island";
  EXPECT_EQ(report.islands_dropped, 1);
  EXPECT_NEAR(report.volume_dropped, 8, 1e-12);
}

TEST(SelectParts, KeepsTheLargestIslandsWithTheirCavities) {
  SelectionReport report;
  const TriMesh kept = select_parts(nested(), {.keep_largest = 1}, &report);
  EXPECT_NEAR(volume_of(kept), 1000 - 216, 1e-9);
  EXPECT_EQ(report.islands_dropped, 3);
  EXPECT_EQ(report.cavities_filled, 0) << "the one that leaves is not filled";
  EXPECT_NEAR(volume_of(select_parts(nested(), {.keep_largest = 2})), 1000 - 216 + 27, 1e-9);
  EXPECT_NEAR(volume_of(select_parts(nested(), {.keep_largest = 99})), volume_of(nested()), 1e-9);
}

TEST(SelectParts, IslandsThatGoWithACavityAreNotAmongTheLargest) {
  const TriMesh kept = select_parts(nested(), {.keep_largest = 3, .fill_cavities = true});
  EXPECT_NEAR(volume_of(kept), 1000 + 27 + 0.125, 1e-9);
}

TEST(SelectParts, WhatIsLeftIsClosedAndItsPointsAreUsed) {
  const TriMesh kept = select_parts(nested(), {.volume_min = 2, .keep_largest = 2});
  const SurfaceCheck check = check_surface(kept);
  EXPECT_TRUE(check.closed() && check.manifold());
  std::vector<char> used(kept.points.size(), 0);
  for (const Triangle& t : kept.triangles) {
    for (const Index p : t) used[static_cast<std::size_t>(p)] = 1;
  }
  EXPECT_EQ(std::count(used.begin(), used.end(), 0), 0);
}

TEST(SelectParts, RefusesAnOpenSurfaceAndTakesNone) {
  TriMesh open = cube();
  open.triangles.pop_back();
  EXPECT_REFUSED(select_parts(open, {}), HasSubstr("3 open edges"));
  EXPECT_TRUE(select_parts({}, {}).triangles.empty());
}

}  // namespace
}  // namespace mesamis
