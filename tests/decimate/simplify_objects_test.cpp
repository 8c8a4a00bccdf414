// SPDX-License-Identifier: Apache-2.0
#include "mesamis/decimate/simplify_objects.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "mesamis/base/parallel.h"
#include "mesamis/surface/distance.h"
#include "mesamis/surface/self_intersections.h"
#include "support/label_grids.h"
#include "support/partition_laws.h"
#include "support/shapes.h"
#include "support/throws.h"

namespace mesamis {
namespace {

/// Objects that share triangles, edges and points, each with points of its own.
std::vector<TriMesh> blob_objects() {
  const OwnedLabels labels = random_blobs(14, 4, 4);
  const PartitionSurface partition = extract_partition_on_grid(smooth_memberships(labels.grid()));
  std::vector<Index> materials = materials_of(partition);
  std::erase(materials, 0);
  return object_surfaces(partition, materials);
}

std::int64_t count_triangles(const std::vector<TriMesh>& objects) {
  std::int64_t triangles = 0;
  for (const TriMesh& object : objects) triangles += std::ssize(object.triangles);
  return triangles;
}

/// The triangles that two of the objects have, as corners from the lowest to the highest.
std::size_t count_shared(const std::vector<TriMesh>& objects) {
  using Corner = std::array<double, 3>;
  std::set<std::array<Corner, 3>> seen;
  std::size_t shared = 0;
  for (const TriMesh& object : objects) {
    for (const Triangle& t : object.triangles) {
      std::array<Corner, 3> corners;
      for (std::size_t i = 0; i < 3; ++i) {
        const Vec3& p = object.points[t[i]];
        corners[i] = {p.x, p.y, p.z};
      }
      std::ranges::sort(corners);
      shared += seen.insert(corners).second ? 0U : 1U;
    }
  }
  return shared;
}

TEST(SimplifyObjects, KeepsEachObjectAndWhatTheyShare) {
  const std::vector<TriMesh> objects = blob_objects();
  ASSERT_GE(objects.size(), 3);
  ASSERT_GT(count_shared(objects), 50);
  for (const double tolerance : {0.05, 0.3}) {
    std::vector<DecimateReport> reports;
    const auto results = simplify_objects(objects, {.tolerance = tolerance}, &reports);
    ASSERT_EQ(results.size(), objects.size());
    EXPECT_GT(count_shared(results), 3);
    for (std::size_t n = 0; n < objects.size(); ++n) {
      const SurfaceCheck check = check_surface(results[n]);
      EXPECT_EQ(flaws_of(check), "");
      EXPECT_EQ(check.components, check_surface(objects[n]).components);
      EXPECT_TRUE(find_self_intersections(results[n]).empty());
      EXPECT_EQ(reports[n].triangles_before, std::ssize(objects[n].triangles));
      EXPECT_EQ(reports[n].triangles_after, std::ssize(results[n].triangles));
      EXPECT_LE(max_distance(objects[n], results[n], 1e-4),
                1.005 * reports[n].original_to_result + 1e-4);
      EXPECT_LE(max_distance(results[n], objects[n], 1e-4),
                1.005 * reports[n].result_to_original + 1e-4);
      EXPECT_LE(std::max(reports[n].original_to_result, reports[n].result_to_original), tolerance);
    }
    EXPECT_LT(count_triangles(results), count_triangles(objects));
  }
}

TEST(SimplifyObjects, CountsSharedTrianglesOnce) {
  const std::vector<TriMesh> objects = blob_objects();
  const auto results = simplify_objects(objects, {.triangles = 400});
  EXPECT_LE(count_triangles(results) - static_cast<std::int64_t>(count_shared(results)), 400);
  EXPECT_GT(count_triangles(results), 390);
}

TEST(SimplifyObjects, RoundsAllPointsAlikeAlsoWithoutATolerance) {
  const std::vector<TriMesh> objects = blob_objects();
  std::vector<DecimateReport> reports;
  const auto results = simplify_objects(objects, {.tolerance = 0}, &reports);
  EXPECT_EQ(count_shared(results), count_shared(objects));
  for (std::size_t n = 0; n < objects.size(); ++n) {
    EXPECT_EQ(results[n].triangles.size(), objects[n].triangles.size());
    EXPECT_GT(reports[n].original_to_result, 0);
    for (const Vec3& p : results[n].points) EXPECT_EQ(static_cast<float>(p.x), p.x);
  }
}

TEST(SimplifyObjects, TakesWhatOnlyTouchesOrLiesTwiceAtOnePlace) {
  // Two cubes at a corner, in one object; a third at an edge of the first; a copy of that.
  const TriMesh twice = joined(cube({0, 0, 0}), cube({1, 1, 1}));
  const std::vector<TriMesh> objects{twice, cube({1, 1, 0}), cube({1, 1, 0})};
  const auto results = simplify_objects(objects, {.tolerance = 0.01});
  for (std::size_t n = 0; n < objects.size(); ++n) {
    EXPECT_EQ(flaws_of(check_surface(results[n])), "");
    EXPECT_EQ(results[n].triangles.size(), objects[n].triangles.size());
  }
  EXPECT_TRUE(simplify_objects({}, {.tolerance = 1}).empty());
}

TEST(SimplifyObjects, HasTheSameBytesForAnyNumberOfThreads) {
  const std::vector<TriMesh> objects = blob_objects();
  const auto run = [&] { return simplify_objects(objects, {.tolerance = 0.1}); };
  const auto one = with_threads(1, run), two = with_threads(2, run);
  for (std::size_t n = 0; n < objects.size(); ++n) EXPECT_EQ(one[n].points, two[n].points);
}

TEST(SimplifyObjects, RefusesWhatIsOutOfRange) {
  EXPECT_REFUSED(simplify_objects({cube()}, {.tolerance = -1}), testing::HasSubstr("tolerance"));
  EXPECT_REFUSED(simplify_objects({cube({1e39, 0, 0})}, {}), testing::HasSubstr("single"));
}

}  // namespace
}  // namespace mesamis
