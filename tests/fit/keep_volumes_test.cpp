// SPDX-License-Identifier: Apache-2.0
#include "mesamis/fit/keep_volumes.h"

#include <gtest/gtest.h>

#include "fit/rough_ball.h"
#include "fit/smooth_surface.h"
#include "mesamis/base/parallel.h"
#include "mesamis/surface/self_intersections.h"
#include "support/label_grids.h"

namespace mesamis {
namespace {

TriMesh shrunk(TriMesh ball, double factor) {
  const Vec3 centre = 0.5 * ball_image().grid.box().extent();
  for (Vec3& p : ball.points) p = centre + factor * (p - centre);
  return ball;
}

TriMesh shifted(TriMesh surface, const std::vector<Vec3>& shifts) {
  for (std::size_t p = 0; p < shifts.size(); ++p) surface.points[p] += shifts[p];
  return surface;
}

TriMesh kept(const TriMesh& ball, const std::array<Index, 2>& sides, double volume) {
  const std::vector<std::array<Index, 2>> of_all(ball.triangles.size(), sides);
  const std::vector<char> on_curve(ball.points.size(), 0);
  const std::vector<double> volumes{0, volume};
  return shifted(ball, keep_volumes({ball, of_all, on_curve, volumes}, ball_image().grid));
}

/// Whichever side of the triangles the ball lies on.
TEST(KeepVolumes, ABallGetsItsVolume) {
  TriMesh ball = moved(ball_surface(kRadius, 40), 0.5 * ball_image().grid.box().extent());
  const double volume = check_surface(ball).volume;
  EXPECT_NEAR(check_surface(kept(shrunk(ball, 0.97), {1, 0}, volume)).volume, volume,
              1e-4 * volume);
  for (Triangle& t : ball.triangles) std::swap(t[1], t[2]);
  const TriMesh turned = kept(shrunk(ball, 1.02), {0, 1}, volume);
  EXPECT_NEAR(-check_surface(turned).volume, volume, 1e-4 * volume);
}

PartitionSurface touching_balls() {
  const OwnedLabels labels = labels_where({30, 22, 22}, {1, 1, 1}, [](const Vec3& p) {
    if (norm(p - Vec3{10, 10.5, 10.5}) < 7) return 1;
    return norm(p - Vec3{19, 10.5, 10.5}) < 6 ? 2 : 0;
  });
  return extract_partition_on_grid(smooth_memberships(labels.grid(), {.most_rounds = 0}));
}

/// Of each material, that of the background is not read.
std::vector<double> volumes_of(const PartitionSurface& partition) {
  std::vector<double> volumes{0};
  for (const Index m : {1, 2}) {
    volumes.push_back(check_surface(object_surface(partition, m)).volume);
  }
  return volumes;
}

TEST(KeepVolumes, ObjectsThatTouchEachHaveTheirs) {
  PartitionSurface partition = touching_balls();
  const TriMesh before{partition.points, partition.triangles};
  VoxelGrid grid;
  grid.size = {30, 22, 22};
  const std::vector<char> on_curve(before.points.size(), 0);
  const Links links(Neighbors(before).points.size(), 1);
  const TriMesh smooth = smooth_surface(before, grid, links, {.bending = 2000, .rounds = 1});
  const std::vector<double> volumes = volumes_of(partition);
  const TriMesh now =
      moved_without_folds(SurfaceSpace(grid, 1), smooth,
                          keep_volumes({smooth, partition.sides, on_curve, volumes}, grid));
  EXPECT_TRUE(find_self_intersections(now).empty());
  for (const Index m : {1, 2}) {
    const double volume = volumes[static_cast<std::size_t>(m)];
    const auto changed = [&](const TriMesh& surface) {
      const PartitionSurface other{surface.points, surface.triangles, partition.sides};
      return std::abs(check_surface(object_surface(other, m)).volume - volume) / volume;
    };
    EXPECT_GT(changed(smooth), 0.01) << m;
    EXPECT_LT(changed(now), 0.002) << m;
  }
}

/// Moves that are made first count.
TEST(KeepVolumes, MovesOfOthersComeFirst) {
  const TriMesh ball = moved(ball_surface(kRadius, 40), 0.5 * ball_image().grid.box().extent());
  const TriMesh small = shrunk(ball, 0.97);
  std::vector<Vec3> shifts;
  for (std::size_t p = 0; p < ball.points.size(); ++p) {
    shifts.push_back(ball.points[p] - small.points[p]);
  }
  const std::vector<std::array<Index, 2>> sides(ball.triangles.size(), {1, 0});
  const std::vector<char> on_curve(ball.points.size(), 0);
  const std::vector<double> volumes{0, check_surface(ball).volume};
  const auto found = keep_volumes({small, sides, on_curve, volumes, shifts}, ball_image().grid);
  for (std::size_t p = 0; p < ball.points.size(); ++p) {
    EXPECT_LT(norm(found[p] - shifts[p]), 1e-6);
  }
}

/// Where one boundary grows and the other shrinks, the third would have a step.
TEST(KeepVolumes, MovesFadeTowardsCurves) {
  const PartitionSurface partition = touching_balls();
  const TriMesh now{partition.points, partition.triangles};
  TriMesh before = now;
  for (Vec3& p : before.points) p.x = 14.5 + 1.03 * (p.x - 14.5);
  VoxelGrid grid;
  grid.size = {30, 22, 22};
  const std::vector<char> on_curve = curve_points(partition);
  const std::vector<double> volumes =
      volumes_of({before.points, before.triangles, partition.sides});
  const auto shifts = keep_volumes({now, partition.sides, on_curve, volumes}, grid);
  double most = 0, step = 0;
  for (const Triangle& t : now.triangles) {
    const auto move = [&](Index p) { return norm(shifts[p]); };
    for (int i = 0; i < 3; ++i) {
      const Index a = t[i], b = t[(i + 1) % 3];
      most = std::max(most, move(a));
      step = std::max(step, std::abs(move(a) - move(b)));
      EXPECT_TRUE(on_curve[a] == 0 || move(a) == 0);
    }
  }
  EXPECT_GT(most, 0.05);
  EXPECT_LT(step, 0.4 * most);
}

TEST(KeepVolumes, HasTheSameBitsForAnyNumberOfThreads) {
  const TriMesh ball = rough_ball(kRadius);
  const double volume = 1.02 * check_surface(ball).volume;
  const auto run = [&] { return kept(ball, {1, 0}, volume); };
  EXPECT_EQ(with_threads(1, run).points, with_threads(3, run).points);
}

}  // namespace
}  // namespace mesamis
