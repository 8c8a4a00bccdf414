// SPDX-License-Identifier: Apache-2.0
#include "mesamis/surface/select_parts.h"

#include <gtest/gtest.h>

#include <random>

#include "mesamis/surface/components.h"
#include "mesamis/surface/nesting.h"
#include "support/shapes.h"
#include "support/throws.h"

namespace mesamis {
namespace {

using ::testing::HasSubstr;

TriMesh turned(TriMesh surface) {
  for (Triangle& t : surface.triangles) std::swap(t[1], t[2]);
  return surface;
}

/// A cube of 10 with a cavity of 6 that holds an island of 2 with a cavity of 1; beside it a cube
/// of 3 and one of 0.5.
TriMesh nested() {
  TriMesh surface = joined(cube({0, 0, 0}, 10), turned(cube({2, 2, 2}, 6)));
  surface = joined(joined(surface, cube({4, 4, 4}, 2)), turned(cube({4.5, 4.5, 4.5}, 1)));
  return joined(joined(surface, cube({20, 0, 0}, 3)), cube({20, 5, 5}, 0.5));
}

double volume_of(const TriMesh& surface) { return check_surface(surface).volume; }

TEST(Nesting, KnowsWhatLiesInWhat) {
  const TriMesh surface = nested();
  const SurfaceComponents parts = find_components(surface);
  const Nesting nesting = find_nesting(surface, parts);
  // Largest first: 1000, -216, 27, 8, -1, 0.125.
  EXPECT_EQ(nesting.depth, (std::vector<int>{0, 1, 0, 2, 3, 0}));
  EXPECT_EQ(nesting.parent, (std::vector<Index>{kNoIndex, 0, kNoIndex, 1, 3, kNoIndex}));
}

/// Rays that meet edges and corners are counted right: all on one lattice.
TEST(Nesting, HoldsWhereRaysMeetEdgesAndPoints) {
  TriMesh surface = cube({0, 0, 0}, 64);
  int inside = 0;
  for (int k = 0; k < 4; ++k) {
    for (int j = 0; j < 4; ++j) {
      for (int i = 0; i < 4; ++i, ++inside) {
        surface = joined(surface, turned(cube({4.0 + 16 * i, 4.0 + 16 * j, 4.0 + 16 * k}, 8)));
      }
    }
  }
  const Nesting nesting = find_nesting(surface, find_components(surface));
  EXPECT_EQ(nesting.depth[0], 0);
  for (std::size_t p = 1; p < nesting.depth.size(); ++p) {
    EXPECT_EQ(nesting.depth[p], 1);
    EXPECT_EQ(nesting.parent[p], 0);
  }
}

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
