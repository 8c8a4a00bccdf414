// SPDX-License-Identifier: Apache-2.0
#include "mesamis/decimate/decimate_patch.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <set>

#include "mesamis/surface/distance.h"
#include "mesamis/surface/farthest.h"
#include "support/level_set.h"

namespace mesamis {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

TriMesh sphere() {
  return level_set({{-1, -1, -1}, {1, 1, 1}}, {10, 10, 10},
                   [](const Vec3& p) { return 0.8 - norm(p); });
}

/// A cover of the patch's points as a surface, with what lies around it.
TriMesh placed(const TriMesh& surface, const Patch& patch, const Cover& cover) {
  TriMesh result{surface.points, patch.around};
  for (Triangle t : cover.triangles) {
    for (Index& p : t) p = patch.points[p];
    result.triangles.push_back(t);
  }
  return result;
}

/// OpenMesh may begin a triangle at another corner.
Triangle from_the_smallest(Triangle t) {
  std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
  return t;
}

TEST(DecimatePatch, KeepsRimsAndStaysNear) {
  const TriMesh surface = sphere();
  const TriangleTree tree(surface);
  const DecimateTask task{surface, {&tree, 1}, 0.05, 0, [](double) {}};
  std::size_t before = 0, after = 0;
  for (const Patch& patch : cut_into_patches(surface.points, cover_of(surface), 0.9)) {
    const DecimatedPatch done = decimate_patch(task, patch);
    before += patch.cover.triangles.size();
    after += done.cover.triangles.size();
    EXPECT_LE(max_distance(placed(surface, patch, done.cover), surface, 1e-3),
              0.05 * kDistanceSlack);
    EXPECT_LE(
        max_distance(placed(surface, patch, patch.cover), placed(surface, patch, done.cover), 1e-3),
        0.05 * kDistanceSlack);
    std::set<Triangle> left;
    for (const Triangle& t : done.cover.triangles) left.insert(from_the_smallest(t));
    for (const Triangle& t : patch.cover.triangles) {
      const bool is_held = patch.held[t[0]] + patch.held[t[1]] + patch.held[t[2]] == 3;
      EXPECT_TRUE(!is_held || left.count(from_the_smallest(t)) == 1);
    }
  }
  EXPECT_LT(after, before * 3 / 4);
}

TEST(DecimatePatch, StandsForTheSameOriginals) {
  const TriMesh surface = sphere();
  const TriangleTree tree(surface);
  const DecimateTask task{surface, {&tree, 1}, 0.05, 0, [](double) {}};
  const auto patches = cut_into_patches(surface.points, cover_of(surface), 0.9);
  const auto originals_in = [](const Cover& cover) {
    std::vector<Index> all;
    for (const auto& some : cover.originals) all.insert(all.end(), some.begin(), some.end());
    std::sort(all.begin(), all.end());
    all.erase(std::unique(all.begin(), all.end()), all.end());
    return all;
  };
  const Cover done = decimate_patch(task, patches[0]).cover;
  EXPECT_EQ(originals_in(done), originals_in(patches[0].cover));
  for (const auto& some : done.originals) EXPECT_TRUE(std::is_sorted(some.begin(), some.end()));
}

TEST(Hold, TakesCornersAndRings) {
  const TriMesh surface = sphere();
  Patch patch = cut_into_patches(surface.points, cover_of(surface), kInfinity)[0];
  hold(patch, {}, {}, 3);
  EXPECT_EQ(std::count(patch.held.begin(), patch.held.end(), 1), 0);
  Patch wider = patch;
  hold(patch, {}, {7}, 0);
  EXPECT_EQ(std::count(patch.held.begin(), patch.held.end(), 1), 3);
  for (const Index p : surface.triangles[7]) EXPECT_EQ(patch.held[p], 1);
  std::vector<char> expected = patch.held;
  choose_rings(surface.triangles, 2, expected);
  hold(wider, {surface.triangles[7][0]}, {7}, 2);
  EXPECT_EQ(wider.held, expected);
}

}  // namespace
}  // namespace mesamis
