// SPDX-License-Identifier: Apache-2.0
#include "mesamis/fit/smooth_surface.h"

#include <gtest/gtest.h>

#include "fit/rough_ball.h"
#include "mesamis/base/parallel.h"
#include "mesamis/surface/self_intersections.h"
#include "support/throws.h"

namespace mesamis {
namespace {

TriMesh smoothed_ball(const TriMesh& start, const SmoothingOptions& options = {}) {
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
    const double volume = check_surface(smoothed_ball(start, {.rounds = rounds})).volume;
    EXPECT_GT(volume, before) << rounds;
    before = volume;
  }
  EXPECT_LE(before, check_surface(start).volume * 1.001);
}

TEST(SmoothSurface, NoPointMovesFarther) {
  const TriMesh start = rough_ball(kRadius);
  const TriMesh smooth = smoothed_ball(start, {.reach = 0.2});
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
