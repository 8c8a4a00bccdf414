// SPDX-License-Identifier: Apache-2.0
#include "mesamis/decimate/patchwork.h"

#include <gtest/gtest.h>

#include <cmath>

#include "mesamis/base/parallel.h"
#include "mesamis/surface/distance.h"
#include "mesamis/surface/farthest.h"
#include "mesamis/surface/self_intersections.h"
#include "support/level_set.h"
#include "support/shapes.h"

namespace mesamis {
namespace {

constexpr Box kBox{{-1, -1, -1}, {1, 1, 1}};

TriMesh torus() {
  return level_set(kBox, {20, 20, 20}, [](const Vec3& p) {
    return 0.25 - std::hypot(std::hypot(p.x, p.y) - 0.6, p.z);
  });
}

/// A shell that is thinner than the tolerance: each side must see the other.
TriMesh thin_shell() {
  TriMesh inner = level_set(kBox, {14, 14, 14}, [](const Vec3& p) { return 0.79 - norm(p); });
  for (Triangle& t : inner.triangles) std::swap(t[1], t[2]);
  return joined(level_set(kBox, {13, 13, 13}, [](const Vec3& p) { return 0.82 - norm(p); }), inner);
}

struct Work {
  TriMesh surface;
  TriangleTree tree{surface};
  DecimateTask task;
  PatchworkReport report{};

  Work(TriMesh s, double tolerance)
      : surface(std::move(s)), task{surface, tree, tolerance, 0, [](double) {}} {}

  Cover run(double side) {
    return decimate_patchwork(task, cut_into_patches(surface.points, cover_of(surface), side),
                              report);
  }

  void expect_promises_kept(const Cover& cover) const {
    const TriMesh result{surface.points, cover.triangles};
    const SurfaceCheck before = check_surface(surface), after = check_surface(result);
    EXPECT_EQ(flaws_of(after), "");
    EXPECT_EQ(after.components, before.components);
    EXPECT_TRUE(find_self_intersections(result).empty());
    EXPECT_LE(max_distance(result, surface, 1e-4), task.tolerance * kDistanceSlack);
    EXPECT_LE(max_distance(surface, result, 1e-4), task.tolerance * kDistanceSlack);
  }
};

TEST(Patchwork, KeepsThePromisesOfDecimation) {
  Work work(torus(), 0.02);
  const Cover cover = work.run(0.8);
  work.expect_promises_kept(cover);
  EXPECT_LT(cover.triangles.size(), work.surface.triangles.size() / 2);
}

TEST(Patchwork, PatchesThatWouldMeetAreMadeAnew) {
  Work work(thin_shell(), 0.1);
  ASSERT_TRUE(find_self_intersections(work.surface).empty());
  // Boxes that part the two sides of the shell here and there.
  work.expect_promises_kept(work.run(0.55));
}

TEST(Patchwork, IsTheSameForAnyNumberOfThreads) {
  Work work(torus(), 0.02);
  const auto run = [&] { return work.run(0.5); };
  const Cover one = with_threads(1, run), three = with_threads(3, run);
  EXPECT_EQ(one.triangles, three.triangles);
  EXPECT_EQ(one.originals, three.originals);
}

}  // namespace
}  // namespace mesamis
