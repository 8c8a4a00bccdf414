// SPDX-License-Identifier: Apache-2.0
#include "mesamis/fit/split_bends.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "fit/rough_ball.h"
#include "mesamis/base/parallel.h"
#include "mesamis/surface/comparison.h"
#include "mesamis/surface/extract_net.h"
#include "mesamis/surface/self_intersections.h"
#include "mesamis/surface/triangle_tree.h"
#include "support/label_grids.h"

namespace mesamis {
namespace {

VoxelGrid wide_grid() {
  VoxelGrid grid;
  grid.size = {40, 40, 40};
  return grid;
}

/// About the middle of the grid.
TriMesh ball(double radius, int count) {
  return moved(ball_surface(radius, count), Vec3{20, 20, 20});
}

SplitBoundaries split(const TriMesh& surface) {
  const std::vector<std::array<Index, 2>> sides(surface.triangles.size(), {0, 1});
  return split_bends({surface, sides, std::vector<char>(surface.points.size(), 0)}, wide_grid());
}

TEST(SplitBends, AnEvenSurfaceStays) {
  const TriMesh fine = ball(10, 40);
  const SplitBoundaries same = split(fine);
  EXPECT_EQ(same.surface.points, fine.points);
  EXPECT_EQ(same.surface.triangles, fine.triangles);
  EXPECT_EQ(same.sides.size(), fine.triangles.size());
}

/// New points lie on the surface as it was, and their shifts lead to the ball.
TEST(SplitBends, ACoarseBallGetsPointsOnTheBall) {
  constexpr double kRound = 10;
  const TriMesh coarse = ball(kRound, 12);
  const SplitBoundaries found = split(coarse);
  EXPECT_EQ(solid_flaws_of(check_surface(found.surface)), "");
  EXPECT_NEAR(check_surface(found.surface).volume, check_surface(coarse).volume,
              1e-12 * check_surface(coarse).volume);
  ASSERT_GT(found.surface.points.size(), coarse.points.size());
  for (std::size_t p = 0; p < found.surface.points.size(); ++p) {
    const double before = kRound - norm(found.surface.points[p] - Vec3{20, 20, 20});
    const Vec3 goal = found.surface.points[p] + found.shifts[p];
    const double after = kRound - norm(goal - Vec3{20, 20, 20});
    if (p < coarse.points.size()) {
      EXPECT_EQ(found.shifts[p], (Vec3{}));
    } else {
      EXPECT_GT(before, 0.05);
      EXPECT_LT(std::abs(after), 0.15 * before);
    }
  }
}

/// Of a partition each object stays closed, and curves where three meet stay as they are.
TEST(SplitBends, ObjectsThatTouchShareNewPoints) {
  const OwnedLabels labels = random_blobs(14, 4, 3);
  const PartitionSurface net = extract_net_on_grid(smooth_memberships(labels.grid()));
  VoxelGrid grid;
  grid.size = labels.size;
  const SplitBoundaries found =
      split_bends({{net.points, net.triangles}, net.sides, curve_points(net)}, grid);
  ASSERT_GT(found.surface.triangles.size(), net.triangles.size());
  const PartitionSurface whole{found.surface.points, found.surface.triangles, found.sides};
  const std::vector<char> before = curve_points(net), after = curve_points(whole);
  for (std::size_t p = 0; p < after.size(); ++p) {
    EXPECT_EQ(after[p], p < before.size() ? before[p] : 0);
  }
  for (const Index m : materials_of(net)) {
    EXPECT_EQ(solid_flaws_of(check_surface(object_surface(whole, m))), "") << m;
  }
}

/// A ball of three objects, cut by discs at the equator and at the ring of points above it: curves.
struct CutBall {
  TriMesh surface;
  std::vector<std::array<Index, 2>> sides;
  std::vector<char> on_curve;
};

CutBall cut_ball(double radius, Index turns) {
  CutBall cut{ball(radius, turns), {}, {}};
  const double above = 20 + radius * std::sin(2 * std::numbers::pi / turns);
  const auto ring_of = [&](const Vec3& p) {  // 1, 2: of the discs; 0: of none
    if (std::abs(p.z - 20) < 1e-9) return 1;
    return std::abs(p.z - above) < 1e-9 ? 2 : 0;
  };
  std::array<std::vector<Index>, 3> rings;
  for (Index p = 0; p < std::ssize(cut.surface.points); ++p) {
    const auto ring = static_cast<std::size_t>(ring_of(cut.surface.points[p]));
    rings[ring].push_back(p);
    cut.on_curve.push_back(ring > 0 ? 1 : 0);
  }
  for (const Triangle& t : cut.surface.triangles) {
    const auto [a, b, c] = corners_of(cut.surface, t);
    const double z = (a.z + b.z + c.z) / 3;
    cut.sides.push_back({0, z < 20 ? 1 : z < above ? 2 : 3});
  }
  for (const std::size_t ring : {1U, 2U}) {
    const auto center = static_cast<Index>(cut.surface.points.size());
    cut.surface.points.push_back({20, 20, ring == 1 ? 20 : above});
    cut.on_curve.push_back(0);
    for (std::size_t i = 0; i < rings[ring].size(); ++i) {
      cut.surface.triangles.push_back(
          {rings[ring][i], rings[ring][(i + 1) % rings[ring].size()], center});
      cut.sides.push_back({static_cast<Index>(ring), static_cast<Index>(ring + 1)});
    }
  }
  return cut;
}

/// Discs and ball meet at the curves: a normal of both would lead off the ball. An edge between the
/// curves has no end that knows how the ball bends.
TEST(SplitBends, BesideCurvesNewPointsGoToTheBallAndBetweenThemEdgesStay) {
  constexpr double kRound = 10;
  constexpr Index kTurns = 20;
  const CutBall cut = cut_ball(kRound, kTurns);
  ASSERT_EQ(std::count(cut.on_curve.begin(), cut.on_curve.end(), 1), 2 * kTurns);
  const SplitBoundaries found = split_bends({cut.surface, cut.sides, cut.on_curve}, wide_grid());
  int beside = 0;
  for (std::size_t n = 0; n < found.edges.size(); ++n) {
    const auto [a, b] = found.edges[n];
    const int on_curves = cut.on_curve[a] + cut.on_curve[b];
    EXPECT_LT(on_curves, 2);
    if (on_curves == 0) continue;
    ++beside;
    const std::size_t p = cut.surface.points.size() + n;
    const Vec3 start = found.surface.points[p] - Vec3{20, 20, 20};
    EXPECT_LT(std::abs(kRound - norm(start + found.shifts[p])), 0.15 * (kRound - norm(start)));
  }
  EXPECT_GE(beside, 2 * kTurns) << "beyond each curve";
}

/// On the box a point has no normal: nothing leaves the box, and its rim stays.
TEST(SplitBends, NothingLeavesTheBox) {
  TriMesh cut = moved(ball_surface(10, 12), {0, 20, 20});
  for (Vec3& p : cut.points) p.x = std::max(p.x, 0.0);
  const SplitBoundaries found = split(cut);
  ASSERT_GT(found.surface.points.size(), cut.points.size());
  for (std::size_t p = cut.points.size(); p < found.surface.points.size(); ++p) {
    EXPECT_GT(found.surface.points[p].x, 0);
    EXPECT_GE(found.surface.points[p].x + found.shifts[p].x, 0);
  }
}

/// Of two ends of an edge both have to be told.
TEST(SplitBends, EdgesThatAreToldStayWhole) {
  const TriMesh coarse = ball(10, 12);
  const std::vector<std::array<Index, 2>> sides(coarse.triangles.size(), {0, 1});
  const std::vector<char> off_curves(coarse.points.size(), 0);
  const auto split_but = [&](const std::vector<char>& whole) {
    return split_bends({coarse, sides, off_curves, whole}, wide_grid());
  };
  const std::vector<std::array<Index, 2>> edges = split(coarse).edges;
  ASSERT_EQ(coarse.points.size() + edges.size(), split(coarse).surface.points.size());
  std::vector<char> whole(coarse.points.size(), 0);
  whole[edges[0][0]] = 1;
  EXPECT_EQ(split_but(whole).edges, edges);
  whole[edges[0][1]] = 1;
  EXPECT_EQ(split_but(whole).edges, (std::vector(edges.begin() + 1, edges.end())));
}

TEST(SplitBends, HasTheSameBitsForAnyNumberOfThreads) {
  const auto run = [] { return split(ball(10, 12)); };
  const SplitBoundaries one = with_threads(1, run), three = with_threads(3, run);
  EXPECT_EQ(one.surface.points, three.surface.points);
  EXPECT_EQ(one.surface.triangles, three.surface.triangles);
  EXPECT_EQ(one.shifts, three.shifts);
}

}  // namespace
}  // namespace mesamis
