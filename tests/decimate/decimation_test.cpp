// SPDX-License-Identifier: Apache-2.0
#include "mesamis/decimate/decimation.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>

#include "mesamis/base/error.h"
#include "mesamis/base/parallel.h"
#include "mesamis/surface/distance.h"
#include "mesamis/surface/self_intersections.h"
#include "support/level_set.h"

namespace mesamis {
namespace {

constexpr double kTolerance = 0.02, kPerPatch = 1000, kOnePatch = 1e9;

/// 15 000 triangles.
TriMesh torus() {
  return level_set({{-1, -1, -1}, {1, 1, 1}}, {30, 30, 30}, [](const Vec3& p) {
    return 0.25 - std::hypot(std::hypot(p.x, p.y) - 0.6, p.z);
  });
}

TriMesh decimated(const TriMesh& surface, double per_patch, const Progress& progress = {}) {
  PatchworkReport report;
  const Cover cover =
      decimate_surface(surface, {.tolerance = kTolerance, .progress = progress}, per_patch, report);
  return {cover.points, cover.triangles};
}

TEST(DecimateSurface, KeepsItsPromisesAndLeavesNoSeams) {
  const TriMesh surface = torus();
  const TriMesh patched = decimated(surface, kPerPatch), whole = decimated(surface, kOnePatch);
  EXPECT_EQ(flaws_of(check_surface(patched)), "");
  EXPECT_EQ(check_surface(patched).components, 1);
  EXPECT_TRUE(find_self_intersections(patched).empty());
  EXPECT_LE(max_distance(patched, surface, 1e-4), kTolerance);
  EXPECT_LE(max_distance(surface, patched, 1e-4), kTolerance);
  EXPECT_NE(patched.triangles, whole.triangles);
  EXPECT_LT(static_cast<double>(patched.triangles.size()),
            1.1 * static_cast<double>(whole.triangles.size()));
}

TEST(DecimateSurface, IsTheSameForAnyNumberOfThreads) {
  const TriMesh surface = torus();
  const TriMesh one = with_threads(1, [&] { return decimated(surface, kPerPatch); });
  const TriMesh three = with_threads(3, [&] { return decimated(surface, kPerPatch); });
  EXPECT_EQ(one.triangles, three.triangles);
}

TEST(DecimateSurface, TellsHowFarItIsOneCallAtATime) {
  std::atomic<int> inside = 0;
  double last = 0;
  bool grows = true, alone = true;
  const Progress progress = [&](std::string_view, double share) {
    alone = alone && inside++ == 0;
    grows = grows && share >= last;
    last = share;
    --inside;
    return true;
  };
  with_threads(3, [&] { decimated(torus(), kPerPatch, progress); });
  EXPECT_TRUE(alone);
  EXPECT_TRUE(grows);
  EXPECT_GT(last, 0.85);
}

TEST(DecimateSurface, StopsWhenTold) {
  const Progress stop = [](std::string_view, double share) { return share < 0.3; };
  EXPECT_THROW(decimated(torus(), kPerPatch, stop), Cancelled);
}

}  // namespace
}  // namespace mesamis
