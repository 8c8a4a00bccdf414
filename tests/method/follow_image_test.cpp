// SPDX-License-Identifier: Apache-2.0
#include "mesamis/method/follow_image.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "mesamis/base/parallel.h"
#include "mesamis/base/single_precision.h"
#include "mesamis/surface/self_intersections.h"
#include "mesamis/surface/split_edges.h"
#include "support/ball_volume.h"
#include "support/level_set.h"
#include "support/shapes.h"

namespace mesamis {
namespace {

constexpr double kRadius = 11, kLevel = 175;
const Vec3 kCenter{19.5, 19.5, 19.5};

/// A ball of few triangles, five voxels long, whose corners alone lie on the sphere.
TriMesh coarse_ball(double radius) {
  return level_set({{0, 0, 0}, {39, 39, 39}}, {8, 8, 8},
                   [radius](const Vec3& p) { return radius - norm(p - kCenter); });
}

SplineImage ball_image(double noise) {
  return interpolating_spline(make_ball({.noise = noise, .radius = kRadius}));
}

/// Root mean square distance of the points and the middles of the triangles from a sphere.
double misfit(const TriMesh& surface, double radius) {
  double sum = 0;
  for (const Triangle& t : surface.triangles) {
    const Vec3 middle =
        (1.0 / 3) * (surface.points[t[0]] + surface.points[t[1]] + surface.points[t[2]]);
    sum += std::pow(norm(middle - kCenter) - radius, 2);
  }
  return std::sqrt(sum / static_cast<double>(surface.triangles.size()));
}

TEST(FollowImage, ComesToTheLevelSetWithoutNoise) {
  const TriMesh coarse = coarse_ball(kRadius);
  const TriMesh followed = follow_image(coarse, ball_image(0), {.level = kLevel, .noise = 0.1});
  const double seen = middle_radius(kRadius, 1);
  EXPECT_GT(misfit(coarse, seen), 0.2);
  EXPECT_LT(misfit(followed, seen), 0.03);
  const SurfaceCheck check = check_surface(followed);
  EXPECT_EQ(check.open_edges + check.nonmanifold_edges + check.misoriented_edges, 0);
  EXPECT_TRUE(find_self_intersections(followed).empty());
}

TEST(FollowImage, ADraftSplitsLessAndMeetsItselfInNoFile) {
  const TriMesh coarse = coarse_ball(kRadius);
  FollowOptions options{.level = kLevel, .noise = 0.1, .smooth = true};
  const TriMesh fine = follow_image(coarse, ball_image(0), options);
  options.draft = true;
  TriMesh draft = follow_image(coarse, ball_image(0), options);
  const double seen = middle_radius(kRadius, 1);
  EXPECT_LT(draft.triangles.size(), fine.triangles.size() / 2);
  EXPECT_LT(misfit(draft, seen), misfit(coarse, seen));
  for (Vec3& p : draft.points) p = rounded(p);
  EXPECT_EQ(flaws_of(check_surface(draft)), "");
  EXPECT_TRUE(find_self_intersections(draft).empty());
}

// Its pieces would be thinner still, down to rounding errors.
TEST(FollowImage, DoesNotSplitThinTriangles) {
  TriMesh surface = coarse_ball(kRadius);
  const Triangle thin = add_thin_triangle(surface, 0.0002);
  FollowedPart part{surface, surface.points, std::vector<char>(surface.points.size(), 0)};
  follow_part(part, ball_image(0), {.level = kLevel, .noise = 0.1});
  const std::vector<Triangle>& followed = part.extracted.triangles;
  EXPECT_EQ(std::ranges::count(followed, thin), 1);
  EXPECT_GT(followed.size(), 2 * surface.triangles.size()) << "others are split";
}

TEST(FollowImage, SortsWhatWasSplitAlongACurve) {
  const TriMesh coarse = coarse_ball(kRadius);
  const FollowOptions options{.level = kLevel, .noise = 0.1};
  const TriMesh followed = follow_image(coarse, ball_image(0), options);
  FollowedPart part{coarse, coarse.points, std::vector<char>(coarse.points.size(), 0)};
  follow_part(part, ball_image(0), options);
  ASSERT_GT(followed.points.size(), 2 * coarse.points.size());
  EXPECT_EQ(followed.triangles.size(), part.extracted.triangles.size());
  // The same points, but for the rounding of other sums.
  std::vector<Vec3> sorted = followed.points, as_split = part.moved;
  for (auto* points : {&sorted, &as_split}) {
    std::ranges::sort(*points, {}, [](const Vec3& p) { return norm(p - Vec3{-31, 57, 13}); });
  }
  for (std::size_t p = 0; p < sorted.size(); ++p) {
    ASSERT_NEAR(norm(sorted[p] - as_split[p]), 0, 1e-6);
  }
  const auto mean_step = [](const std::vector<Triangle>& triangles) {
    double sum = 0;
    for (const Triangle& t : triangles) sum += std::abs(t[0] - t[1]);
    return sum / static_cast<double>(triangles.size());
  };
  EXPECT_LT(mean_step(followed.triangles), 0.5 * mean_step(part.extracted.triangles));
}

TEST(FollowImage, LeavesASurfaceThatNoiseExplains) {
  // A surface that is right stays nearly so, though the image's level set is rough.
  const double seen = middle_radius(kRadius, 1);
  const TriMesh fine = level_set({{0, 0, 0}, {39, 39, 39}}, {39, 39, 39},
                                 [seen](const Vec3& p) { return seen - norm(p - kCenter); });
  const TriMesh followed = follow_image(fine, ball_image(12), {.level = kLevel, .noise = 12});
  EXPECT_LT(misfit(followed, seen), 0.08) << "the image's own level set is 0.2 off";
  // And where there is more noise than could ever help, nothing is touched.
  const TriMesh same = follow_image(fine, ball_image(40), {.level = kLevel, .noise = 40});
  EXPECT_EQ(same.triangles, fine.triangles);
}

TEST(FollowImage, DoesNotMakeASurfaceMeetItself) {
  // Noise that it is not told of, and a surface that is far off.
  const TriMesh followed =
      follow_image(coarse_ball(kRadius - 0.6), ball_image(25), {.level = kLevel, .noise = 1});
  EXPECT_TRUE(find_self_intersections(followed).empty());
  EXPECT_EQ(check_surface(followed).open_edges, 0);
}

TEST(FollowImage, KeepsWhatLiesOnTheBox) {
  const TriMesh half = level_set({{0, 0, 0}, {39, 39, 39}}, {8, 8, 8},
                                 [](const Vec3& p) { return 19.5 + 0.2 * p.y - p.x; });
  SplineImage image = interpolating_spline(make_ball({.noise = 0}));
  const TriMesh followed = follow_image(half, image, {.level = kLevel, .noise = 1});
  const Box box = bounding_box(followed.points), before = bounding_box(half.points);
  EXPECT_EQ(norm(box.lo - before.lo), 0);
  EXPECT_NEAR(check_surface(followed).volume, check_surface(half).volume,
              0.05 * check_surface(half).volume);
}

TEST(FollowImage, SplitsNoEdgesOnTheBox) {
  // A ball that the box cuts off: outlines on its walls are bent, but nothing there may move.
  const TriMesh cut = coarse_ball(24);
  const SplineImage image = interpolating_spline(make_ball({.noise = 0, .radius = 24.5}));
  const TriMesh followed = follow_image(cut, image, {.level = kLevel, .noise = 0.1});
  const auto on_walls = [&](const TriMesh& surface) {
    const Box box = image.grid.box();
    return std::count_if(
        surface.triangles.begin(), surface.triangles.end(), [&](const Triangle& t) {
          const Vec3 middle =
              (1.0 / 3) * (surface.points[t[0]] + surface.points[t[1]] + surface.points[t[2]]);
          return middle.x == box.lo.x || middle.y == box.lo.y || middle.z == box.lo.z;
        });
  };
  EXPECT_GT(followed.triangles.size(), cut.triangles.size());
  EXPECT_GT(on_walls(cut), 20);
  EXPECT_EQ(on_walls(followed), on_walls(cut));
}

TEST(FollowImage, StaysInTheBox) {
  // A ball that the box cuts off by a third of a voxel, and a surface that ends short of that.
  const TriMesh inside = coarse_ball(19.3);
  const SplineImage image = interpolating_spline(make_ball({.noise = 0, .radius = 19.8}));
  const TriMesh followed = follow_image(inside, image, {.level = kLevel, .noise = 0.1});
  const Box found = bounding_box(followed.points), image_box = image.grid.box();
  EXPECT_GT(misfit(followed, 19.3), 0.1);
  for (int a = 0; a < 3; ++a) {
    EXPECT_GT(found.lo[a], image_box.lo[a]);
    EXPECT_LT(found.hi[a], image_box.hi[a]);
  }
}

TEST(FollowImage, LeavesWhatLiesOutsideTheBox) {
  TriMesh across = coarse_ball(kRadius);
  for (Vec3& p : across.points) p.x += 19.5 + 9;  // beyond the box by a voxel and a half
  const TriMesh followed = follow_image(across, ball_image(0), {.level = kLevel, .noise = 0.1});
  for (std::size_t p = 0; p < across.points.size(); ++p) {
    if (across.points[p].x < 39) continue;
    EXPECT_EQ(followed.points[p], across.points[p]);
  }
}

TEST(FollowImage, TheUnitOfTheSurfaceDoesNotMatter) {
  const FollowOptions mm{.level = kLevel, .noise = 3};
  const SplineImage image = ball_image(3);
  const TriMesh coarse = coarse_ball(kRadius);
  TriMesh halved = coarse;
  for (Vec3& p : halved.points) p = 0.5 * p;
  const TriMesh expected = follow_image(coarse, image, mm);
  const TriMesh found = follow_image(halved, image, {kLevel, 3, 2});
  ASSERT_EQ(found.triangles, expected.triangles);
  for (std::size_t p = 0; p < found.points.size(); ++p) {
    EXPECT_LT(norm(2 * found.points[p] - expected.points[p]), 1e-9);
  }
}

/// A ball of small triangles whose points lie off the sphere by so many voxels of white noise.
TriMesh rippled_ball(double radius, double ripple) {
  TriMesh ball = level_set({{0, 0, 0}, {39, 39, 39}}, {39, 39, 39},
                           [radius](const Vec3& p) { return radius - norm(p - kCenter); });
  std::mt19937 random(7);
  std::normal_distribution<double> noise(0, ripple);
  for (Vec3& p : ball.points) p += noise(random) * unit_or_zero(p - kCenter);
  return ball;
}

/// Root mean square distance of the points from their own mean radius.
double ripple_of(const TriMesh& ball) {
  double sum = 0, squares = 0;
  for (const Vec3& p : ball.points) {
    const double r = norm(p - kCenter);
    sum += r;
    squares += r * r;
  }
  const auto n = static_cast<double>(ball.points.size());
  return std::sqrt(squares / n - sum / n * sum / n);
}

/// Smoothing alone.
FollowOptions smoothing(double noise) {
  return {.level = kLevel, .noise = noise, .to_image = false, .smooth = true};
}

TEST(FollowImage, SmoothsRipples) {
  const double seen = middle_radius(kRadius, 1);
  const TriMesh rippled = rippled_ball(seen, 0.08);
  const TriMesh smooth = follow_image(rippled, ball_image(0), smoothing(12));
  EXPECT_EQ(smooth.triangles, rippled.triangles);
  EXPECT_LT(ripple_of(smooth), 0.4 * ripple_of(rippled));
  EXPECT_NEAR(check_surface(smooth).volume, check_surface(rippled).volume,
              0.005 * check_surface(rippled).volume);
}

TEST(FollowImage, SmoothsLessWhereThereIsLittleNoise) {
  const double seen = middle_radius(kRadius, 1);
  const TriMesh rippled = rippled_ball(seen, 0.08);
  const auto left = [&](double noise) {
    return ripple_of(follow_image(rippled, ball_image(0), smoothing(noise)));
  };
  EXPECT_GT(left(0.1), 1.1 * left(20));
}

TEST(FollowImage, HoldsMoreFirmlyWhatTheImageShowsThin) {
  const TriMesh strut = level_set({{0, 0, 0}, {39, 39, 39}}, {39, 39, 39}, [](const Vec3& p) {
    return 1.5 - std::hypot(p.x - kCenter.x, p.y - kCenter.y);
  });
  const auto shrunk_in_ball_of = [&](double radius) {
    const SplineImage image = interpolating_spline(make_ball({.noise = 0, .radius = radius}));
    const TriMesh smooth = follow_image(strut, image, smoothing(20));
    return check_surface(strut).volume - check_surface(smooth).volume;
  };
  const double thick = shrunk_in_ball_of(30), thin = shrunk_in_ball_of(1.2);
  EXPECT_GT(thin, 0);
  EXPECT_LT(thin, 0.7 * thick);
}

TEST(FollowImage, SmoothsNoPointThatIsHeld) {
  const TriMesh rippled = rippled_ball(kRadius, 0.08);
  FollowedPart part{rippled, rippled.points, std::vector<char>(rippled.points.size(), kFree)};
  for (std::size_t p = 0; p < part.held.size(); p += 3) part.held[p] = p % 2 == 0 ? kHeld : kFixed;
  const std::vector<char> held = part.held;
  const SplineImage image = ball_image(0);
  follow_part(part, image, smoothing(12));
  int moved = 0;
  for (std::size_t p = 0; p < held.size(); ++p) {
    if (held[p] != kFree) {
      EXPECT_EQ(part.moved[p], rippled.points[p]);
    } else if (part.moved[p] != rippled.points[p]) {
      ++moved;
      EXPECT_LT(norm(part.moved[p] - rippled.points[p]), 0.2501);
    }
  }
  EXPECT_GT(moved, 100);
}

TEST(FollowImage, ChangesNothingThatItIsNotAskedTo) {
  const TriMesh rippled = rippled_ball(kRadius, 0.08);
  const TriMesh same =
      follow_image(rippled, ball_image(0), {.level = kLevel, .noise = 1, .to_image = false});
  EXPECT_EQ(same.points, rippled.points);
}

TEST(FollowImage, SameBitsForAnyNumberOfThreads) {
  const SplineImage image = ball_image(6);
  const TriMesh coarse = coarse_ball(kRadius);
  const FollowOptions options{.level = kLevel, .noise = 6, .smooth = true};
  const auto follow = [&] { return follow_image(coarse, image, options); };
  const TriMesh one = with_threads(1, follow), three = with_threads(3, follow);
  ASSERT_EQ(one.points.size(), three.points.size());
  for (std::size_t p = 0; p < one.points.size(); ++p) EXPECT_EQ(one.points[p], three.points[p]);
}

}  // namespace
}  // namespace mesamis
