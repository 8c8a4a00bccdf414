// SPDX-License-Identifier: Apache-2.0
#include "mesamis/decimate/decimate_patch.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "support/level_set.h"

namespace mesamis {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

TriMesh sphere() {
  return level_set({{-1, -1, -1}, {1, 1, 1}}, {10, 10, 10},
                   [](const Vec3& p) { return 0.8 - norm(p); });
}

TEST(DecimatePatch, KeepsRimsAndWhatIsHeld) {
  const TriMesh surface = sphere();
  const TriangleTree tree(surface);
  const DecimateTask task{surface, tree, 0.05, 0, [](double) {}};
  for (const Patch& patch : cut_into_patches(surface.points, cover_of(surface), 0.9)) {
    const DecimatedPatch done = decimate_patch(task, patch);
    EXPECT_LE(done.cover.triangles.size(), patch.cover.triangles.size());
    EXPECT_GE(done.passes, 1);
    std::vector<char> used(patch.points.size(), 0);
    for (const Triangle& t : done.cover.triangles) {
      for (const Index p : t) used[p] = 1;
    }
    for (std::size_t p = 0; p < used.size(); ++p) EXPECT_GE(used[p], patch.held[p]) << p;
  }
}

TEST(DecimatePatch, StandsForTheSameOriginals) {
  const TriMesh surface = sphere();
  const TriangleTree tree(surface);
  const DecimateTask task{surface, tree, 0.05, 0, [](double) {}};
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

TEST(HoldWhatStandsFor, HoldsTheCornersAndRings) {
  const TriMesh surface = sphere();
  Patch patch = cut_into_patches(surface.points, cover_of(surface), kInfinity)[0];
  hold_what_stands_for(patch, {}, 3);
  EXPECT_EQ(std::count(patch.held.begin(), patch.held.end(), 1), 0);
  Patch wider = patch;
  hold_what_stands_for(patch, {7}, 0);
  EXPECT_EQ(std::count(patch.held.begin(), patch.held.end(), 1), 3);
  for (const Index p : surface.triangles[7]) EXPECT_EQ(patch.held[p], 1);
  std::vector<char> expected = patch.held;
  choose_rings(surface.triangles, 2, expected);
  hold_what_stands_for(wider, {7}, 2);
  EXPECT_EQ(wider.held, expected);
}

}  // namespace
}  // namespace mesamis
