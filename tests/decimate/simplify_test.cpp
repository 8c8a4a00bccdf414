// SPDX-License-Identifier: Apache-2.0
#include "mesamis/decimate/simplify.h"

#include <gtest/gtest.h>

#include <cmath>

#include "mesamis/base/parallel.h"
#include "mesamis/decimate/refit.h"
#include "mesamis/decimate/round_to_single.h"
#include "mesamis/surface/distance.h"
#include "mesamis/surface/self_intersections.h"
#include "support/level_set.h"

namespace mesamis {
namespace {

TriMesh torus() {
  return round_to_single(level_set({{-1, -1, -1}, {1, 1, 1}}, {30, 30, 30}, [](const Vec3& p) {
    return 0.25 - std::hypot(std::hypot(p.x, p.y) - 0.6, p.z);
  }));
}

double mean_of_points(const TriMesh& from, const TriMesh& to) {
  return summarize(distances_to_surface(from.points, to)).mean;
}

TEST(Simplify, IsNearerThanDecimationAtTheSameNumberOfTriangles) {
  const TriMesh surface = torus();
  DecimateReport report;
  const TriMesh simple = simplify(surface, {.tolerance = 0.02}, &report);
  const auto triangles = std::ssize(simple.triangles);
  EXPECT_LT(triangles, std::ssize(surface.triangles) / 4);
  const TriMesh decimated = decimate(surface, {.tolerance = 0.02, .triangles = triangles});
  EXPECT_NEAR(static_cast<double>(decimated.triangles.size()), static_cast<double>(triangles), 2);
  EXPECT_LT(mean_of_points(surface, simple), 0.9 * mean_of_points(surface, decimated));
}

TEST(Simplify, KeepsThePromisesOfBothSteps) {
  const TriMesh surface = torus();
  DecimateReport report;
  const TriMesh simple = simplify(surface, {.tolerance = 0.02}, &report);
  EXPECT_EQ(flaws_of(check_surface(simple)), "");
  EXPECT_TRUE(find_self_intersections(simple).empty());
  EXPECT_EQ(report.triangles_after, std::ssize(simple.triangles));
  EXPECT_LE(std::max(report.original_to_result, report.result_to_original), 0.02 * 1.01);
  EXPECT_LE(max_distance(surface, simple, 1e-4), 1.005 * report.original_to_result + 1e-4);
  EXPECT_LE(max_distance(simple, surface, 1e-4), 1.005 * report.result_to_original + 1e-4);
}

TEST(Simplify, OnlyDecimatesToANumberAndLeavesAllWithoutATolerance) {
  const TriMesh surface = torus();
  EXPECT_EQ(simplify(surface, {.triangles = 500}).points,
            decimate(surface, {.triangles = 500}).points);
  EXPECT_EQ(simplify(surface, {.tolerance = 0}).points, surface.points);
}

TEST(Simplify, HasTheSameBytesForAnyNumberOfThreads) {
  const TriMesh surface = torus();
  const auto run = [&] { return simplify(surface, {.tolerance = 0.02}); };
  const TriMesh one = with_threads(1, run), three = with_threads(3, run);
  EXPECT_EQ(one.points, three.points);
  EXPECT_EQ(one.triangles, three.triangles);
}

}  // namespace
}  // namespace mesamis
