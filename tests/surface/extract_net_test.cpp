// SPDX-License-Identifier: Apache-2.0
#include "mesamis/surface/extract_net.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "mesamis/base/parallel.h"
#include "mesamis/mesh/kuhn.h"
#include "mesamis/surface/measure.h"
#include "support/label_grids.h"
#include "support/partition_laws.h"
#include "support/random_memberships.h"
#include "support/throws.h"

namespace mesamis {
namespace {

TEST(ExtractNet, HoldsTheLawsOfPartitionsWhereLabelsAreRandom) {
  for (unsigned seed = 1; seed <= 60; ++seed) {
    const Index materials = 2 + static_cast<Index>(seed % 5);
    const GridMemberships grid = random_grid({5, 4, 6}, materials, seed);
    expect_partition_laws(extract_net_on_grid(grid), 4 * 6 * 2.5, "seed " + std::to_string(seed));
  }
}

TEST(ExtractNet, HoldsTheLawsOfPartitionsWhereObjectsTouch) {
  for (unsigned seed = 1; seed <= 12; ++seed) {
    const OwnedLabels labels = random_blobs(14, 2 + static_cast<int>(seed) % 6, seed);
    const PartitionSurface net = extract_net_on_grid(smooth_memberships(labels.grid()));
    expect_partition_laws(net, labels.box_volume(), "seed " + std::to_string(seed));
  }
}

/// Here a quadrilateral's two triangles would meet others, whichever diagonal cuts it.
TEST(ExtractNet, KeepsFourTrianglesWhereTwoWouldMeetOthers) {
  const std::string materials =
      "00111112211111222111122233312222333001111100411112251111222333322223330001111004"
      "411105543112255333222533300001110006411005743125554332255533";
  const std::string values =
      "00102220020200020002222001212110022221020100020011001211010020110000000200112020"
      "10021010220200121222211112000100200110020100001001110020201001220201202021102000"
      "11021122101221120022012020120111002120011211021022002022210211202222011222101022"
      "20110020000021111110012101200222122012011210002212100122221021110201111212201022"
      "0220000002200001022";
  GridMemberships grid{.size = {7, 5, 4},
                       .spacing = {0.1, 1, 1},
                       .material = {},
                       .label = {0, 5, 4, 2, 3, 1, 4, 5},
                       .first = {0},
                       .listed = {},
                       .value = {}};
  for (const char m : materials) grid.material.push_back(m - '0');
  for (Index n = 0; n < 7 * 5 * 4; ++n) {
    const auto [i, j, k] = grid_place(grid.size, n);
    std::set<Index> listed{grid.material[static_cast<std::size_t>(n)]};
    for (const auto& [di, dj, dk] : kKuhnSteps) {
      for (const Index way : {-1, 1}) {
        const Index x = i + way * di, y = j + way * dj, z = k + way * dk;
        if (std::min({x, y, z}) < 0 || x > 6 || y > 4 || z > 3) continue;
        listed.insert(grid.material[static_cast<std::size_t>(x + 7 * (y + 5 * z))]);
      }
    }
    for (const Index m : listed) {
      grid.value.push_back(static_cast<float>(values[grid.value.size()] - '0'));
      grid.listed.push_back(m);
    }
    grid.first.push_back(std::ssize(grid.value));
  }
  ASSERT_EQ(grid.value.size(), values.size());
  expect_partition_laws(extract_net_on_grid(grid), 0.6 * 4 * 3, "thin voxels");
}

/// Labels that are not chosen are one object with the background, which touches itself at an edge or a
/// corner as rarely as any other.
TEST(ExtractNet, HoldsTheLawsForChosenLabels) {
  for (unsigned seed = 1; seed <= 60; ++seed) {
    const GridMemberships grid = random_grid({5, 4, 6}, 6, seed);
    PartitionSurface net = extract_net_on_grid(grid, {.chosen = {0, 1, 0, 1, 0, 0}});
    PartitionSurface seen{net.points, {}, {}};
    for (std::size_t t = 0; t < net.sides.size(); ++t) {
      Triangle triangle = net.triangles[t];
      std::array<Index, 2> sides = net.sides[t];
      for (Index& m : sides) m = m == kNoIndex || m == 1 || m == 3 ? m : 0;
      ASSERT_NE(sides[0], sides[1]) << "a boundary between labels that are not chosen";
      if (sides[1] != kNoIndex && sides[1] < sides[0]) {
        std::swap(sides[0], sides[1]);
        std::swap(triangle[1], triangle[2]);
      }
      seen.triangles.push_back(triangle);
      seen.sides.push_back(sides);
    }
    expect_partition_laws(seen, 4 * 6 * 2.5, "seed " + std::to_string(seed));
  }
}

OwnedLabels ball_labels(double radius) {
  return labels_where({30, 30, 30}, {1, 1, 1}, [&](const Vec3& p) {
    return norm(p - Vec3{14.3, 14.6, 14.4}) < radius ? 1 : 0;
  });
}

/// Labels that are not chosen leave no trace: the net of a chosen one is that of itself alone, but
/// for where it lies.
TEST(ExtractNet, HasNoMoreTrianglesForLabelsThatAreNotChosen) {
  const OwnedLabels alone = ball_labels(10);
  OwnedLabels among = alone;
  for (std::size_t n = 0; n < among.labels.size(); ++n) {
    if (among.labels[n] == 0)
      among.labels[n] = static_cast<std::uint16_t>(n % 30 < 15 ? 2 : n / 30 % 30 < 14 ? 3 : 4);
  }
  const NetOptions chosen{.close_at_box = false, .chosen = {0, 1}};
  const PartitionSurface one = extract_net_on_grid(smooth_memberships(alone.grid()), chosen),
                         all = extract_net_on_grid(smooth_memberships(among.grid()), chosen);
  ASSERT_GT(one.triangles.size(), 1000u);
  EXPECT_LE(std::ssize(all.triangles), 1.1 * static_cast<double>(one.triangles.size()));
}

/// Of a closed surface.
std::int64_t euler_characteristic(const TriMesh& surface) {
  return std::ssize(surface.points) - std::ssize(surface.triangles) / 2;
}

/// Parts, cavities and handles are those of the grid's tetrahedra.
TEST(ExtractNet, HasTheTopologyOfTheTetrahedra) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const GridMemberships grid = random_grid({6, 6, 6}, 2 + static_cast<Index>(seed % 3), seed);
    const PartitionSurface net = extract_net_on_grid(grid);
    const PartitionSurface whole = extract_partition_on_grid(grid);
    ASSERT_EQ(materials_of(net), materials_of(whole));
    for (const Index m : materials_of(whole)) {
      const TriMesh some = object_surface(net, m), all = object_surface(whole, m);
      EXPECT_EQ(check_surface(some).components, check_surface(all).components) << seed;
      EXPECT_EQ(euler_characteristic(some), euler_characteristic(all)) << seed;
    }
  }
}

/// A point in each cube that the boundary crosses, two triangles for each edge.
TEST(ExtractNet, ABallHasOnePointInACube) {
  const GridMemberships grid = smooth_memberships(ball_labels(10).grid());
  const TriMesh ball = object_surface(extract_net_on_grid(grid), 1);
  const TriMesh fine = object_surface(extract_partition_on_grid(grid), 1);
  EXPECT_LT(5 * ball.triangles.size() / 2, fine.triangles.size());
  EXPECT_NEAR(check_surface(ball).volume, check_surface(fine).volume,
              0.01 * check_surface(fine).volume);
  double off = 0;
  for (const Vec3& p : ball.points) {
    off +=
        std::abs(norm(p - Vec3{14.3, 14.6, 14.4}) - 10) / static_cast<double>(ball.points.size());
  }
  EXPECT_LT(off, 0.1);
}

TEST(ExtractNet, PartsOfSomeSlicesJoinToTheWhole) {
  for (unsigned seed = 1; seed <= 6; ++seed) {
    const GridMemberships grid = random_grid({5, 5, 12}, 2 + static_cast<Index>(seed % 3), seed);
    const PartitionSurface whole = extract_net_on_grid(grid);
    std::vector<PartitionPart> parts;
    for (const auto& [begin, end] : {NodeSlices{0, 5}, NodeSlices{5, 7}, NodeSlices{7, 12}}) {
      const Index first = std::max(0, begin - 1), last = std::min(12, end + 2);
      GridMemberships some{
          .size = {5, 5, last - first},
          .spacing = grid.spacing,
          .material = {grid.material.begin() + 25 * first, grid.material.begin() + 25 * last},
          .label = grid.label,
          .first = {0},
          .listed = {},
          .value = {},
          .below = first,
          .above = 12 - last};
      for (Index n = 25 * first; n < 25 * last; ++n) {
        const auto at = static_cast<std::size_t>(n);
        for (std::int64_t i = grid.first[at]; i < grid.first[at + 1]; ++i) {
          some.listed.push_back(grid.listed[static_cast<std::size_t>(i)]);
          some.value.push_back(grid.value[static_cast<std::size_t>(i)]);
        }
        some.first.push_back(static_cast<std::int64_t>(some.value.size()));
      }
      parts.push_back(extract_net_part(some, {begin - first, end - first}));
    }
    const PartitionSurface joined = join_parts(std::move(parts));
    EXPECT_EQ(joined.points, whole.points);
    EXPECT_EQ(joined.triangles, whole.triangles);
    EXPECT_EQ(joined.sides, whole.sides);
  }
}

TEST(ExtractNet, HasTheSameBytesForAnyNumberOfThreads) {
  const GridMemberships grid = random_grid({20, 20, 20}, 4, 5);
  const auto one = with_threads(1, [&] { return extract_net_on_grid(grid); });
  const auto two = with_threads(2, [&] { return extract_net_on_grid(grid); });
  EXPECT_EQ(one.points, two.points);
  EXPECT_EQ(one.triangles, two.triangles);
  EXPECT_EQ(one.sides, two.sides);
}

TEST(ExtractNet, RefusesWhatDoesNotFit) {
  GridMemberships grid = random_grid({3, 3, 3}, 2, 1);
  grid.material.pop_back();
  EXPECT_REFUSED(extract_net_on_grid(grid), testing::HasSubstr("one material per node"));
}

}  // namespace
}  // namespace mesamis
