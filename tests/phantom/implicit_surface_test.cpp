// SPDX-License-Identifier: Apache-2.0
#include "mesamis/phantom/implicit_surface.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "mesamis/base/parallel.h"
#include "mesamis/surface/self_intersections.h"
#include "support/throws.h"

namespace mesamis {
namespace {

using testing::HasSubstr;

constexpr double kPi = 3.14159265358979323846;

GridLines even_lines(double lo, double hi, int n) {
  std::vector<double> axis;
  for (int i = 0; i <= n; ++i) axis.push_back(lo + (hi - lo) * i / n);
  return {axis, axis, axis};
}

double ball(const Vec3& p) { return 10 - norm(p - Vec3{0.1, 0.2, -0.3}); }

double ring(const Vec3& p) { return 3 - std::hypot(std::hypot(p.x, p.y) - 8, p.z); }

TEST(ImplicitSurface, OfABallIsWithinTheTolerance) {
  for (const double tolerance : {0.1, 0.01, 0.001}) {
    const TriMesh surface = extract_implicit(even_lines(-12, 12, 10), ball, tolerance);
    const SurfaceCheck check = check_surface(surface);
    EXPECT_TRUE(check.closed() && check.manifold());
    EXPECT_EQ(check.components, 1);
    const double area = 4 * kPi * 100;
    EXPECT_NEAR(check.volume, area * 10 / 3, area * tolerance);
    EXPECT_LT(check.volume, area * 10 / 3);  // chords
    EXPECT_NEAR(check.area / area, 1, 4 * tolerance);
    const ImplicitError error = implicit_error(surface, ball);
    EXPECT_LE(error.max, 1.01 * tolerance);
    EXPECT_GT(error.max, 0.2 * tolerance);
    EXPECT_LE(error.mean, error.max);
    for (const Vec3& p : surface.points) ASSERT_NEAR(ball(p), 0, 5e-4);
  }
}

TEST(ImplicitSurface, HasTheHandleOfARing) {
  const TriMesh surface = extract_implicit(even_lines(-12, 12, 17), ring, 0.02);
  const auto triangles = static_cast<std::int64_t>(surface.triangles.size());
  EXPECT_EQ(static_cast<std::int64_t>(surface.points.size()) - triangles / 2, 0);  // Euler
  EXPECT_THAT(find_self_intersections(surface), testing::IsEmpty());
  EXPECT_NEAR(check_surface(surface).volume / (2 * kPi * kPi * 8 * 9), 1, 0.01);
}

TEST(ImplicitSurface, ErrorIsTheDistanceOfAShiftedBall) {
  const TriMesh surface = extract_implicit(even_lines(-12, 12, 20), ball, 1e-3);
  const auto larger = [](const Vec3& p) { return 0.5 * (ball(p) + 0.25); };  // half as steep
  const ImplicitError error = implicit_error(surface, larger);
  EXPECT_NEAR(error.max, 0.25, 2e-3);
  EXPECT_NEAR(error.mean, 0.25, 2e-3);
}

/// A cube with round edges, of half side 4.
double die(const Vec3& p) {
  const auto beyond = [](double x) { return std::max(std::abs(x) - 3, 0.0); };
  const double outer = 1 - norm(Vec3{beyond(p.x), beyond(p.y), beyond(p.z)});
  const double inner = 4 - std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  return inner > 1 ? inner : outer;
}

/// Values that the search for zeros meets exactly.
TEST(ImplicitSurface, TakesNodesAtZero) {
  const TriMesh surface = extract_implicit(even_lines(-8, 8, 16), die, 0.01);
  const SurfaceCheck check = check_surface(surface);
  EXPECT_TRUE(check.closed() && check.manifold());
  const double exact = 6 * 6 * 6 + 6 * 6 * 6 + 12 * 6 * kPi / 4 + 4 * kPi / 3;
  EXPECT_NEAR(check.volume, exact, 384 * 0.01);
  EXPECT_THAT(find_self_intersections(surface), testing::IsEmpty());
  EXPECT_LE(implicit_error(surface, die).max, 0.0101);
}

/// A sharp edge breaks the promise of a continuous gradient: still closed, and no endless cutting.
TEST(ImplicitSurface, StaysClosedAtSharpEdges) {
  const auto cube = [](const Vec3& p) {
    return 4.3 - std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  };
  const TriMesh surface = extract_implicit(even_lines(-8, 8, 16), cube, 0.2);
  EXPECT_TRUE(check_surface(surface).closed() && check_surface(surface).manifold());
  EXPECT_NEAR(check_surface(surface).volume, 8.6 * 8.6 * 8.6, 4);
}

TEST(ImplicitSurface, IsTheSameOnAnyNumberOfThreads) {
  const TriMesh all = extract_implicit(even_lines(-12, 12, 30), ring, 0.01);
  const TriMesh one =
      with_threads(1, [&] { return extract_implicit(even_lines(-12, 12, 30), ring, 0.01); });
  EXPECT_EQ(all.points, one.points);
  EXPECT_EQ(all.triangles, one.triangles);
}

TEST(ImplicitSurface, OfNothingIsEmpty) {
  const auto none = [](const Vec3&) { return -1.0; };
  EXPECT_TRUE(extract_implicit(even_lines(0, 1, 3), none, 1).triangles.empty());
}

TEST(ImplicitSurface, RefusesBadGridsAndTolerances) {
  EXPECT_REFUSED(extract_implicit(even_lines(0, 1, 0), ball, 1), HasSubstr("found 1"));
  EXPECT_REFUSED(extract_implicit(even_lines(1, 0, 3), ball, 1), HasSubstr("do not ascend"));
  EXPECT_REFUSED(extract_implicit(even_lines(0, 1, 3), ball, 0), HasSubstr("tolerance"));
}

}  // namespace
}  // namespace mesamis
