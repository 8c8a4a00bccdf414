// SPDX-License-Identifier: Apache-2.0
#include "mesamis/fit/smooth_surface.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "fit/rough_ball.h"
#include "fit/smooth_surface.h"
#include "mesamis/base/parallel.h"
#include "mesamis/surface/extract_net.h"
#include "mesamis/surface/grid_partition.h"
#include "mesamis/surface/self_intersections.h"
#include "mesamis/surface/smooth_memberships.h"
#include "mesamis/surface/triangle_tree.h"
#include "support/label_grids.h"
#include "support/throws.h"

namespace mesamis {
namespace {

/// Of points nearer to each other than those of a net, which is what the defaults are for.
constexpr double kFine = 640;

TriMesh smoothed_ball(const TriMesh& start, const SmoothingOptions& options = {.bending = kFine}) {
  const Links all(Neighbors(start).points.size(), 1);
  return smooth_surface(start, ball_image().grid, all, options);
}

TEST(SmoothSurface, RoughnessGoesAndTheShapeStays) {
  const TriMesh start = rough_ball(kRadius);
  const TriMesh smooth = smoothed_ball(start);
  const auto [mean, deviation] = distance_of(smooth);
  EXPECT_NEAR(mean, distance_of(start).first, 0.02);
  EXPECT_LT(deviation, 0.25 * distance_of(start).second);
  EXPECT_NEAR(check_surface(smooth).volume, check_surface(start).volume,
              0.01 * check_surface(start).volume);
  EXPECT_EQ(solid_flaws_of(check_surface(smooth)), "");
  EXPECT_TRUE(find_self_intersections(smooth).empty());
}

/// What a round loses of a bend comes back in the next ones.
TEST(SmoothSurface, ASmallBallShrinksLessTheMoreRounds) {
  const TriMesh start = moved(ball_surface(2, 24), 0.5 * ball_image().grid.box().extent());
  double before = 0;
  for (const int rounds : {1, 2, 4}) {
    const double volume =
        check_surface(smoothed_ball(start, {.bending = kFine, .rounds = rounds})).volume;
    EXPECT_GT(volume, before) << rounds;
    before = volume;
  }
  EXPECT_LE(before, check_surface(start).volume * 1.001);
}

/// How far the normals of a ball's triangles turn from its radii, root mean square by area, radians.
double roughness(const TriMesh& surface, const Vec3& centre) {
  double sum = 0, area = 0;
  for (const Triangle& t : surface.triangles) {
    const Corners c = corners_of(surface, t);
    const Vec3 across = cross(c[1] - c[0], c[2] - c[0]);
    const Vec3 radius = unit_or_zero((1.0 / 3) * (c[0] + c[1] + c[2]) - centre);
    sum += norm(across) * std::pow(std::acos(std::min(1.0, dot(unit_or_zero(across), radius))), 2);
    area += norm(across);
  }
  return std::sqrt(sum / area);
}

/// The largest distance of a point from a ball's surface.
double farthest(const TriMesh& surface, const Vec3& centre, double radius) {
  double most = 0;
  for (const Vec3& p : surface.points) most = std::max(most, std::abs(norm(p - centre) - radius));
  return most;
}

TEST(SmoothSurface, StepsOfThickSlicesGo) {
  const Vec3 centre{31.3, 31.6, 31.2};
  const OwnedLabels labels = labels_where(
      {64, 64, 22}, {1, 1, 3}, [&](const Vec3& p) { return norm(p - centre) < 27 ? 1 : 0; });
  const PartitionSurface partition =
      extract_net_on_grid(smooth_memberships(labels.grid(), {.most_rounds = 0}));
  const TriMesh start = object_surface(partition, 1);
  VoxelGrid grid;
  grid.size = {64, 64, 22};
  grid.spacing = {1, 1, 3};
  const Links all(Neighbors(start).points.size(), 1);
  const TriMesh usual = smooth_surface(start, grid, all);
  const TriMesh smooth = smooth_surface(start, grid, all, smoothing_of_labels(grid));
  EXPECT_LT(roughness(smooth, centre), 0.6 * roughness(usual, centre));
  EXPECT_LT(farthest(smooth, centre, 27), farthest(start, centre, 27));
  const double volume = check_surface(start).volume;
  EXPECT_NEAR(check_surface(smooth).volume, volume, 0.02 * volume);
}

TEST(SmoothSurface, LabelsOfCubesAreSmoothedAsUsual) {
  const SmoothingOptions usual, of_cubes = smoothing_of_labels(ball_image().grid);
  EXPECT_EQ(of_cubes.bending, usual.bending);
  EXPECT_EQ(of_cubes.rounds, usual.rounds);
  EXPECT_EQ(of_cubes.reach, usual.reach);
}

/// Where moves would make the surface meet itself, few points stop for good.
TEST(SmoothSurface, GoesOnWhereOthersHaveMadeRoom) {
  std::mt19937 generator(2);
  OwnedLabels labels = labels_where({14, 14, 14}, {1, 1, 1},
                                    [&](const Vec3&) { return static_cast<int>(generator() % 3); });
  const PartitionSurface net =
      extract_net_on_grid(smooth_memberships(labels.grid(), {.most_rounds = 0}));
  const TriMesh start{net.points, net.triangles};
  VoxelGrid grid;
  grid.size = {14, 14, 14};
  const Neighbors neighbors(start);
  const Links all(neighbors.points.size(), 1);
  const Umbrella umbrella(neighbors, all);
  const auto bends = [&](const TriMesh& surface) {
    double sum = 0;
    for (const Vec3& bend : umbrella.bent(surface.points)) sum += dot(bend, bend);
    return sum;
  };
  const TriMesh smooth = smooth_surface(start, grid, all, smoothing_of_labels(grid));
  EXPECT_LT(bends(smooth), 0.4 * bends(start));
  EXPECT_TRUE(find_self_intersections(smooth).empty());
}

TEST(SmoothSurface, NoPointMovesFarther) {
  const TriMesh start = rough_ball(kRadius);
  const TriMesh smooth = smoothed_ball(start, {.bending = kFine, .reach = 0.2});
  for (std::size_t p = 0; p < start.points.size(); ++p) {
    EXPECT_LE(norm(smooth.points[p] - start.points[p]), 0.2 + 1e-9);
  }
}

TEST(SmoothSurface, LeavesPointsOnTheBox) {
  TriMesh start = moved(ball_surface(kRadius, 30), {0, 19.5, 19.5});
  for (Vec3& p : start.points) p.x = std::max(p.x, 0.0);
  const TriMesh smooth = smoothed_ball(start);
  for (std::size_t p = 0; p < start.points.size(); ++p) {
    if (start.points[p].x > 0) continue;
    EXPECT_EQ(smooth.points[p], start.points[p]);
  }
}

/// Smoothing would leave a thread of a rod that is two voxels wide, and does if it cannot tell parts.
TEST(SmoothSurface, AThinPartKeepsItsWidth) {
  const OwnedLabels labels = labels_where({30, 30, 24}, {1, 1, 1}, [](const Vec3& p) {
    const bool rod = p.x >= 3 && p.x < 5 && p.y >= 3 && p.y < 5 && p.z >= 2 && p.z < 22;
    return rod || norm(p - Vec3{18, 18, 12}) < 8 ? 1 : 0;
  });
  const PartitionSurface net = extract_net_on_grid(smooth_memberships(labels.grid()));
  const TriMesh start{net.points, net.triangles};
  const Links all(Neighbors(start).points.size(), 1);
  const BoundaryParts parts = parts_of_boundaries(start, net.sides);
  VoxelGrid grid;
  grid.size = labels.size;
  const auto left = [&](const BoundaryParts* known) {
    const TriMesh smooth{smooth_places({start, all, known}, grid), start.triangles};
    std::vector<double> share = enclosed_volumes(smooth, parts.sides);
    for (std::size_t p = 1; p < share.size(); ++p) share[p] /= parts.volumes[p];
    return share;
  };
  const std::vector<double> without = left(nullptr), with = left(&parts);
  ASSERT_EQ(with.size(), 3U);
  const std::size_t rod = parts.volumes[1] < parts.volumes[2] ? 1 : 2, ball = 3 - rod;
  EXPECT_LT(without[rod], 0.6);
  EXPECT_GT(with[rod], 0.75);
  EXPECT_NEAR(with[ball], without[ball], 1e-3);
  EXPECT_NEAR(with[ball], 1, 0.02);
}

TEST(SmoothSurface, HasTheSameBitsForAnyNumberOfThreads) {
  const TriMesh start = rough_ball(kRadius);
  const auto run = [&] { return smoothed_ball(start); };
  EXPECT_EQ(with_threads(1, run).points, with_threads(3, run).points);
}

TEST(SmoothSurface, NeedsAnEntryPerNeighbour) {
  EXPECT_REFUSED(smooth_surface(rough_ball(kRadius), ball_image().grid, {}),
                 "smoothing: expected an entry for each neighbour of each point");
}

}  // namespace
}  // namespace mesamis
