// SPDX-License-Identifier: Apache-2.0
#include "mesamis/fit/fit_surface.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "fit/rough_ball.h"
#include "fit/smooth_surface.h"
#include "mesamis/base/parallel.h"
#include "mesamis/surface/half_edges.h"
#include "mesamis/surface/self_intersections.h"
#include "mesamis/surface/triangle_tree.h"
#include "support/edge_lengths.h"
#include "support/sampled_volume.h"
#include "support/shapes.h"
#include "support/throws.h"

namespace mesamis {
namespace {

FitPoints points_of(const TriMesh& surface, double contrast) {
  return {std::vector<double>(surface.points.size(), contrast),
          std::vector<char>(surface.points.size(), 0), Links(Neighbors(surface).points.size(), 1)};
}

/// A rough ball that was smoothed, as labels are before they are fitted.
TriMesh smooth_start(double radius) {
  const TriMesh rough = rough_ball(radius);
  const Links all(Neighbors(rough).points.size(), 1);
  return smooth_surface(rough, ball_image().grid, all, {.bending = 2000});
}

/// Of the edges' length the share where triangles meet at more than 40 degrees.
double share_of_creases(const TriMesh& surface) {
  const EdgeLengths lengths = edge_lengths(surface);
  return lengths.creases / lengths.all;
}

TEST(FitSurface, LiesOnTheImageAndIsSmooth) {
  for (const double radius : {kRadius - 1, kRadius + 0.8}) {
    const TriMesh start = smooth_start(radius);
    const TriMesh fitted = fit_surface(start, ball_image(), points_of(start, 110), {});
    const auto [mean, deviation] = distance_of(fitted);
    EXPECT_NEAR(mean, 0, 0.08) << radius;
    EXPECT_LT(deviation, 0.1) << radius << ": the noise alone moves its level set by that";
    EXPECT_EQ(solid_flaws_of(check_surface(fitted)), "");
    EXPECT_TRUE(find_self_intersections(fitted).empty());
  }
}

TEST(FitSurface, StaysWhereNoEdgeIsSeen) {
  const TriMesh start = smooth_start(kRadius - 1);
  EXPECT_EQ(fit_surface(start, ball_image(), points_of(start, 0), {}).points, start.points);
}

/// Points that look for no edge go with those beside them.
TEST(FitSurface, IsEvenWhereHalfOfItSeesAnEdge) {
  const TriMesh start = smooth_start(kRadius - 1);
  FitPoints points = points_of(start, 110);
  const Vec3 centre = 0.5 * ball_image().grid.box().extent();
  for (std::size_t p = 0; p < start.points.size(); ++p) {
    if (start.points[p].z < centre.z) points.contrast[p] = 0;
  }
  const TriMesh fitted = fit_surface(start, ball_image(), points, {});
  EXPECT_LT(share_of_creases(fitted), 0.01);
  const auto moved_by = [&](std::size_t p) { return norm(fitted.points[p] - start.points[p]); };
  for (const Triangle& t : start.triangles) {
    EXPECT_LT(std::abs(moved_by(t[0]) - moved_by(t[1])), 0.25);
  }
}

/// The darker side may be behind the surface.
TEST(FitSurface, TheSignOfTheContrastTurnsTheEdge) {
  TriMesh inside_out = smooth_start(kRadius - 0.5);
  for (Triangle& t : inside_out.triangles) std::swap(t[1], t[2]);
  const TriMesh fitted = fit_surface(inside_out, ball_image(), points_of(inside_out, -110), {});
  EXPECT_NEAR(distance_of(fitted).first, 0, 0.08);
}

/// Two boundaries that see the same edge would lie upon each other.
TEST(FitSurface, IsSmoothWhereBoundariesWouldMeet) {
  TriMesh both = smooth_start(kRadius - 1);
  const auto inner = static_cast<Index>(both.points.size());
  const TriMesh outer = smooth_start(kRadius + 1.2);
  both.points.insert(both.points.end(), outer.points.begin(), outer.points.end());
  for (const Triangle& t : outer.triangles) {
    both.triangles.push_back({t[0] + inner, t[2] + inner, t[1] + inner});
  }
  FitPoints points = points_of(both, 110);
  std::fill(points.contrast.begin() + inner, points.contrast.end(), -110);
  const TriMesh fitted = fit_surface(both, ball_image(), points, {});
  EXPECT_TRUE(find_self_intersections(fitted).empty());
  EXPECT_LT(share_of_creases(fitted), 0.01);
}

/// A bright ball in a bright room, with a dark gap between them.
SplineImage ball_in_a_room(double ball, double room) {
  constexpr double kBlur = 0.35;
  const Vec3 centre = 0.5 * ball_image().grid.box().extent();
  return interpolating_spline(sampled_volume({40, 40, 40}, {1, 1, 1}, [&](const Vec3& p) {
    const auto beyond = [&](double radius) {
      return std::erf((norm(p - centre) - radius) / (std::sqrt(2.0) * kBlur));
    };
    return 230 - 55 * (beyond(ball) - beyond(room));
  }));
}

/// The first two see the ball and meet there. The third sees the room, within where the second was:
/// it meets that one once it comes back, far from where both were when the first two met.
TEST(FitSurface, IsSmoothWhereOneThatComesBackMeetsAnother) {
  const SplineImage image = ball_in_a_room(kRadius, kRadius + 1.2);
  TriMesh all;
  std::vector<double> contrast;
  for (const auto& [radius, sees] :
       {std::pair{kRadius - 0.8, 110.0}, std::pair{kRadius + 1.4, 110.0},
        std::pair{kRadius + 2.6, -110.0}}) {
    all = joined(all, moved(ball_surface(radius, 90), 0.5 * image.grid.box().extent()));
    contrast.resize(all.points.size(), sees);
  }
  FitPoints points = points_of(all, 0);
  points.contrast = std::move(contrast);
  const TriMesh fitted = fit_surface(all, image, points, {});
  EXPECT_TRUE(find_self_intersections(fitted).empty());
  EXPECT_LT(share_of_creases(fitted), 0.001) << "the start has none";
}

TEST(FitSurface, LeavesPointsOnTheBox) {
  TriMesh start = moved(ball_surface(kRadius, 30), {0, 19.5, 19.5});
  for (Vec3& p : start.points) p.x = std::max(p.x, 0.0);
  const TriMesh fitted = fit_surface(start, ball_image(), points_of(start, 0), {});
  for (std::size_t p = 0; p < start.points.size(); ++p) {
    if (start.points[p].x > 0) continue;
    EXPECT_EQ(fitted.points[p], start.points[p]);
  }
}

TEST(FitSurface, HasTheSameBitsForAnyNumberOfThreads) {
  const TriMesh start = smooth_start(kRadius - 0.5);
  const auto run = [&] { return fit_surface(start, ball_image(), points_of(start, 110), {}); };
  EXPECT_EQ(with_threads(1, run).points, with_threads(3, run).points);
}

TEST(FitSurface, NeedsAnEntryPerPoint) {
  const TriMesh start = rough_ball(kRadius);
  EXPECT_REFUSED(fit_surface(start, ball_image(), {}, {}),
                 "fit: expected an entry for each point of the surface and each neighbour of it");
}

}  // namespace
}  // namespace mesamis
