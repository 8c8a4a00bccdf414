// SPDX-License-Identifier: Apache-2.0
#include "mesamis/surface/distance.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "mesamis/base/error.h"
#include "mesamis/base/parallel.h"
#include "mesamis/surface/sampling.h"
#include "support/shapes.h"
#include "surface/random_surfaces.h"

namespace mesamis {
namespace {

/// Least distance to any triangle, by minimising over barycentric coordinates in long double: the
/// inside by the normal equations, else the three edges.
double brute_distance(const Vec3& p, const TriMesh& surface) {
  using Real = long double;
  Real nearest = std::numeric_limits<Real>::infinity();
  for (const Triangle& k : surface.triangles) {
    const Vec3 &a = surface.points[k[0]], &b = surface.points[k[1]], &c = surface.points[k[2]];
    std::array<Real, 3> e, f, q;
    for (int i = 0; i < 3; ++i) {
      e[i] = Real(b[i]) - a[i], f[i] = Real(c[i]) - a[i], q[i] = Real(p[i]) - a[i];
    }
    auto product = [](const auto& x, const auto& y) {
      return x[0] * y[0] + x[1] * y[1] + x[2] * y[2];
    };
    auto length2 = [&](Real s, Real t) {
      std::array<Real, 3> r;
      for (int i = 0; i < 3; ++i) r[i] = q[i] - s * e[i] - t * f[i];
      return product(r, r);
    };
    auto share = [](Real x, Real y) { return y > 0 ? std::clamp(x / y, Real(0), Real(1)) : 0; };
    const Real ee = product(e, e), ff = product(f, f), ef = product(e, f);
    const Real eq = product(e, q), fq = product(f, q), det = ee * ff - ef * ef;
    const Real s = (ff * eq - ef * fq) / det, t = (ee * fq - ef * eq) / det;
    if (det > 0 && s >= 0 && t >= 0 && s + t <= 1) nearest = std::min(nearest, length2(s, t));
    nearest = std::min({nearest, length2(share(eq, ee), 0), length2(0, share(fq, ff))});
    const Real w = share(fq - eq - ef + ee, ee + ff - 2 * ef);
    nearest = std::min(nearest, length2(1 - w, w));
  }
  return static_cast<double>(std::sqrt(nearest));
}

TEST(Distance, AgreesWithBruteForceAtAllLengthRatios) {
  for (const Vec3& stretch : {Vec3{1, 1, 1}, Vec3{1000, 1, 1}, Vec3{1000, 1000, 1}}) {
    const TriMesh surface = random_triangles(300, stretch);
    const auto points = random_points(300, -0.5 * stretch, 1.5 * stretch, 2);
    const std::vector<double> distances = distances_to_surface(points, surface);
    for (std::size_t i = 0; i < points.size(); ++i) {
      EXPECT_NEAR(distances[i], brute_distance(points[i], surface), 1e-12 * stretch.x) << i;
    }
  }
}

TEST(Distance, AgreesWithBruteForceOnNeedles) {
  // Flat long triangles in all directions, 1000 : 1 and points right beside them.
  std::mt19937 generator(3);
  std::normal_distribution<double> normal;
  auto direction = [&] { return Vec3{normal(generator), normal(generator), normal(generator)}; };
  TriMesh surface;
  std::vector<Vec3> points;
  for (Index t = 0; t < 200; ++t) {
    const Vec3 a = 100 * direction(), along = 1000 * direction(), across = direction();
    surface.points.insert(surface.points.end(), {a, a + along, a + 0.3 * along + across});
    surface.triangles.push_back({3 * t, 3 * t + 1, 3 * t + 2});
    points.push_back(a + 0.3 * along + 0.5 * across + 0.1 * direction());
  }
  const std::vector<double> distances = distances_to_surface(points, surface);
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_NEAR(distances[i], brute_distance(points[i], surface), 1e-10) << i;
  }
}

TEST(Distance, AgreesWithBruteForceOnTrianglesOfEveryKind) {
  const TriMesh surface = mixed_triangles(400);
  auto points = random_points(2000, {-0.5, -0.5, -0.5}, {1.5, 1.5, 1.5}, 8);
  for (const Vec3& p : random_points(400, {-1e-3, -1e-3, -1e-3}, {1e-3, 1e-3, 1e-3}, 9)) {
    points.push_back(surface.points[points.size() % surface.points.size()] + p);  // close by
  }
  const std::vector<double> distances = distances_to_surface(points, surface);
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_NEAR(distances[i], brute_distance(points[i], surface), 1e-12) << i;
  }
}

TEST(Distance, OfATranslatedSquareIsTheTranslation) {
  const TriMesh square{{{0, 0, 0}, {9, 0, 0}, {9, 9, 0}, {0, 9, 0}}, {{0, 1, 2}, {0, 2, 3}}};
  TriMesh moved = square;
  for (Vec3& p : moved.points) p += Vec3{0, 0, 0.3};
  for (const double d : distances_to_surface(moved.points, square)) EXPECT_DOUBLE_EQ(d, 0.3);
  for (Vec3& p : moved.points) p += Vec3{-4, 0, 2.7};
  EXPECT_EQ(distances_to_surface(moved.points, square), (std::vector<double>{5, 3, 3, 5}));
}

TEST(Distance, OfPointsOnTheSurfaceIsZero) {
  const TriMesh surface = random_triangles(500, {1, 1, 1});
  for (const double d : distances_to_surface(surface.points, surface)) EXPECT_EQ(d, 0);
  for (const double d : distances_to_surface(sample_by_area(surface, 500), surface)) {
    EXPECT_LT(d, 1e-14);
  }
}

TEST(Distance, CopesWithEqualTriangles) {
  TriMesh surface{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {}};
  surface.triangles.assign(1000, {0, 1, 2});
  const std::vector<Vec3> points{{0.2, 0.2, 2}, {-3, -4, 0}};
  EXPECT_EQ(distances_to_surface(points, surface), (std::vector<double>{2, 5}));
}

TEST(Distance, HasTheSameBitsForAnyNumberOfThreads) {
  const TriMesh surface = random_triangles(2000, {1, 1, 1});
  const auto points = random_points(10'000, {-1, -1, -1}, {2, 2, 2}, 5);
  const auto one = with_threads(1, [&] { return distances_to_surface(points, surface); });
  with_threads(3, [&] { EXPECT_EQ(distances_to_surface(points, surface), one); });
}

TEST(Distance, RefusesWhatHasNoAnswer) {
  const std::vector<Vec3> points{{0, 0, 0}};
  EXPECT_THROW(distances_to_surface(points, {}), InputError);
  EXPECT_THROW(distances_to_surface(points, {{{0, 0, 0}}, {{0, 0, 1}}}), InputError);
  const std::vector<Vec3> bad{{0, std::nan(""), 0}};
  EXPECT_THROW(distances_to_surface(bad, cube()), InputError);
  EXPECT_TRUE(distances_to_surface({}, cube()).empty());
}

TEST(MaxDistance, IsThatOfTheFarthestPointNotOfTheFarthestCorner) {
  // A roof over a square: all corners lie on the flat one, the ridge does not.
  const TriMesh flat{{{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}}, {{0, 1, 2}, {0, 2, 3}}};
  const TriMesh roof{{{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}, {0, 1, 0.5}, {2, 1, 0.5}},
                     {{0, 1, 5}, {0, 5, 4}, {4, 5, 2}, {4, 2, 3}}};
  EXPECT_NEAR(max_distance(roof, flat, 1e-3), 0.5, 0.005);
  // The middle of the square is nearest to the slopes, at a right angle.
  EXPECT_NEAR(max_distance(flat, roof, 1e-3), 1 * std::sin(std::atan(0.5)), 0.005);
  EXPECT_EQ(max_distance(flat, flat, 1e-3), 1e-3);
}

TEST(MaxDistance, BoundsSamplesClosely) {
  const TriMesh a = random_triangles(60, {1, 1, 1}, 1), b = random_triangles(60, {1, 1, 1}, 2);
  const double bound = max_distance(a, b, 1e-3);
  const auto samples = distances_to_surface(sample_by_area(a, 200'000), b);
  const double sampled = *std::max_element(samples.begin(), samples.end());
  EXPECT_GE(bound, sampled);
  EXPECT_LE(bound, 1.03 * sampled);
}

TEST(MaxDistance, HasTheSameBitsForAnyNumberOfThreads) {
  const TriMesh a = random_triangles(1500, {9, 9, 9}, 1), b = random_triangles(500, {9, 9, 9}, 2);
  const double one = with_threads(1, [&] { return max_distance(a, b, 1e-2); });
  with_threads(3, [&] { EXPECT_EQ(max_distance(a, b, 1e-2), one); });
}

TEST(Summarize, KnowsOneToAHundred) {
  std::vector<double> values;
  for (int i = 100; i >= 1; --i) values.push_back(i);
  const DistanceSummary summary = summarize(values);
  EXPECT_EQ(summary.count, 100u);
  EXPECT_DOUBLE_EQ(summary.mean, 50.5);
  EXPECT_DOUBLE_EQ(summary.rms, std::sqrt(3383.5));
  EXPECT_EQ(summary.p95, 95);
  EXPECT_EQ(summary.p99, 99);
  EXPECT_EQ(summary.max, 100);
}

TEST(Summarize, OfOneAndOfNone) {
  const DistanceSummary one = summarize({3});
  EXPECT_EQ(one.p95, 3);
  EXPECT_EQ(one.p99, 3);
  EXPECT_EQ(one.max, 3);
  EXPECT_EQ(summarize({}).count, 0u);
  EXPECT_EQ(summarize({}).max, 0);
}

}  // namespace
}  // namespace mesamis
