// SPDX-License-Identifier: Apache-2.0
#include "mesamis/fit/keep_volumes.h"

#include <gtest/gtest.h>

#include "fit/rough_ball.h"
#include "mesamis/base/parallel.h"
#include "mesamis/fit/smooth_surface.h"
#include "mesamis/surface/self_intersections.h"
#include "support/label_grids.h"

namespace mesamis {
namespace {

TriMesh shrunk(TriMesh ball, double factor) {
  const Vec3 centre = 0.5 * ball_image().grid.box().extent();
  for (Vec3& p : ball.points) p = centre + factor * (p - centre);
  return ball;
}

TriMesh kept(const TriMesh& before, const TriMesh& now, const std::array<Index, 2>& sides) {
  const std::vector<std::array<Index, 2>> of_all(now.triangles.size(), sides);
  const std::vector<char> on_curve(now.points.size(), 0);
  return keep_volumes({before, now, of_all, on_curve}, ball_image().grid);
}

/// Whichever side of the triangles the ball lies on.
TEST(KeepVolumes, ABallHasItsVolumeAgain) {
  TriMesh ball = moved(ball_surface(kRadius, 40), 0.5 * ball_image().grid.box().extent());
  const double volume = check_surface(ball).volume;
  EXPECT_NEAR(check_surface(kept(ball, shrunk(ball, 0.97), {1, 0})).volume, volume, 1e-4 * volume);
  for (Triangle& t : ball.triangles) std::swap(t[1], t[2]);
  const TriMesh turned = kept(ball, shrunk(ball, 1.02), {0, 1});
  EXPECT_NEAR(-check_surface(turned).volume, volume, 1e-4 * volume);
}

PartitionSurface touching_balls() {
  const OwnedLabels labels = labels_where({30, 22, 22}, {1, 1, 1}, [](const Vec3& p) {
    if (norm(p - Vec3{10, 10.5, 10.5}) < 7) return 1;
    return norm(p - Vec3{19, 10.5, 10.5}) < 6 ? 2 : 0;
  });
  return extract_partition_on_grid(smooth_memberships(labels.grid(), {.most_rounds = 0}));
}

TEST(KeepVolumes, ObjectsThatTouchEachHaveTheirs) {
  PartitionSurface partition = touching_balls();
  const TriMesh before{partition.points, partition.triangles};
  VoxelGrid grid;
  grid.size = {30, 22, 22};
  const std::vector<char> on_curve(before.points.size(), 0);
  const Links links(Neighbors(before).points.size(), 1);
  const TriMesh smooth = smooth_surface(before, grid, links, {.bending = 2000, .rounds = 1});
  const TriMesh now = keep_volumes({before, smooth, partition.sides, on_curve}, grid);
  EXPECT_TRUE(find_self_intersections(now).empty());
  for (const Index m : {1, 2}) {
    const double volume = check_surface(object_surface(partition, m)).volume;
    const auto changed = [&](const TriMesh& surface) {
      const PartitionSurface other{surface.points, surface.triangles, partition.sides};
      return std::abs(check_surface(object_surface(other, m)).volume - volume) / volume;
    };
    EXPECT_GT(changed(smooth), 0.01) << m;
    EXPECT_LT(changed(now), 0.002) << m;
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
  const TriMesh moved = keep_volumes({before, now, partition.sides, on_curve}, grid);
  double most = 0, step = 0;
  for (const Triangle& t : now.triangles) {
    const auto move = [&](Index p) { return norm(moved.points[p] - now.points[p]); };
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
  const auto run = [&] { return kept(ball, shrunk(ball, 0.98), {1, 0}); };
  EXPECT_EQ(with_threads(1, run).points, with_threads(3, run).points);
}

}  // namespace
}  // namespace mesamis
