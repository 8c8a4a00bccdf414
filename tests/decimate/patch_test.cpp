// SPDX-License-Identifier: Apache-2.0
#include "mesamis/decimate/patch.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <set>

#include "support/level_set.h"

namespace mesamis {
namespace {

TriMesh sphere() {
  return level_set({{-1, -1, -1}, {1, 1, 1}}, {12, 12, 12},
                   [](const Vec3& p) { return 0.8 - norm(p); });
}

/// The corners in the original, beginning with the smallest.
Triangle in_the_original(const Patch& patch, Triangle t) {
  for (Index& p : t) p = patch.points[p];
  std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
  return t;
}

std::multiset<Triangle> triangles_of(const std::vector<Patch>& patches) {
  std::multiset<Triangle> all;
  for (const Patch& patch : patches) {
    for (const Triangle& t : patch.cover.triangles) all.insert(in_the_original(patch, t));
  }
  return all;
}

/// The triangles of the surface that touch a patch and are not its own, sorted.
std::vector<Triangle> triangles_around(const TriMesh& surface, const Patch& patch) {
  std::set<Index> points(patch.points.begin(), patch.points.end()), own;
  for (const auto& originals : patch.cover.originals)
    own.insert(originals.begin(), originals.end());
  std::vector<Triangle> around;
  for (Index t = 0; t < std::ssize(surface.triangles); ++t) {
    const Triangle& k = surface.triangles[t];
    const bool touches =
        std::any_of(k.begin(), k.end(), [&](Index p) { return points.count(p) > 0; });
    if (touches && own.count(t) == 0) around.push_back(k);
  }
  std::sort(around.begin(), around.end());
  return around;
}

TEST(CutIntoPatches, KeepsEveryTriangleOnce) {
  const TriMesh surface = sphere();
  const auto whole = cut_into_patches(cover_of(surface), std::numeric_limits<double>::infinity());
  ASSERT_EQ(whole.size(), 1u);
  const auto cut = cut_into_patches(cover_of(surface), 0.5);
  EXPECT_GT(cut.size(), 20u);
  EXPECT_EQ(triangles_of(whole).size(), surface.triangles.size());
  EXPECT_EQ(triangles_of(cut), triangles_of(whole));
  for (const Patch& patch : cut) {
    ASSERT_EQ(patch.cover.originals.size(), patch.cover.triangles.size());
    for (std::size_t t = 0; t < patch.cover.triangles.size(); ++t) {
      ASSERT_EQ(patch.cover.originals[t].size(), 1u);
      Triangle original = surface.triangles[patch.cover.originals[t][0]];
      std::rotate(original.begin(), std::min_element(original.begin(), original.end()),
                  original.end());
      EXPECT_EQ(in_the_original(patch, patch.cover.triangles[t]), original);
    }
  }
}

TEST(CutIntoPatches, HoldsNothingInAWhole) {
  const TriMesh surface = sphere();
  const auto whole = cut_into_patches(cover_of(surface), std::numeric_limits<double>::infinity());
  EXPECT_EQ(std::count(whole[0].held.begin(), whole[0].held.end(), 1), 0);
  EXPECT_TRUE(whole[0].around.empty());
}

/// Points that patches of a lattice hold.
std::set<Index> held_points(const TriMesh& surface, double side) {
  std::set<Index> held;
  for (const Patch& patch : cut_into_patches(cover_of(surface), side)) {
    for (std::size_t i = 0; i < patch.points.size(); ++i) {
      if (patch.held[i] != 0) held.insert(patch.points[i]);
    }
  }
  return held;
}

// So that few points are left which neither frees.
TEST(CutIntoPatches, ALatticeOfTwiceTheSideFreesMostOfWhatTheOtherHolds) {
  const TriMesh surface = sphere();
  const auto first = held_points(surface, 1), second = held_points(surface, 2);
  std::vector<Index> both;
  std::set_intersection(first.begin(), first.end(), second.begin(), second.end(),
                        std::back_inserter(both));
  EXPECT_GT(first.size(), 50u);
  EXPECT_LT(both.size(), first.size() / 2);
}

TEST(CutIntoPatches, HoldsWhatTouchesASharedPoint) {
  const TriMesh surface = sphere();
  const auto cut = cut_into_patches(cover_of(surface), 0.5);
  std::vector<int> patches_at(surface.points.size(), 0);
  for (const Patch& patch : cut) {
    for (const Index p : patch.points) ++patches_at[p];
  }
  for (const Patch& patch : cut) {
    std::vector<char> expected(patch.points.size(), 0);
    for (const Triangle& t : patch.cover.triangles) {
      const bool touches =
          std::any_of(t.begin(), t.end(), [&](Index p) { return patches_at[patch.points[p]] > 1; });
      for (const Index p : t) expected[p] |= touches ? 1 : 0;
    }
    EXPECT_EQ(patch.held, expected);
    EXPECT_EQ(patch.around, triangles_around(surface, patch));
  }
}

/// What has no chosen corner makes the last patch and stays.
TEST(CutIntoPatches, HoldsTheRest) {
  const TriMesh surface = sphere();
  std::vector<char> chosen(surface.points.size());
  for (std::size_t p = 0; p < chosen.size(); ++p) chosen[p] = surface.points[p].x > 0.3 ? 1 : 0;
  for (const double side : {0.5, std::numeric_limits<double>::infinity()}) {
    const auto cut = cut_into_patches(cover_of(surface), side, chosen);
    ASSERT_GE(cut.size(), 2u);
    EXPECT_EQ(triangles_of(cut).size(), surface.triangles.size());
    for (const Patch& patch : cut) {
      const bool is_rest = &patch == &cut.back();
      for (const Triangle& t : patch.cover.triangles) {
        const bool any =
            std::any_of(t.begin(), t.end(), [&](Index p) { return chosen[patch.points[p]] != 0; });
        EXPECT_NE(any, is_rest);
      }
      const bool is_held = std::count(patch.held.begin(), patch.held.end(), 0) == 0;
      EXPECT_TRUE(is_held || !is_rest);
      EXPECT_TRUE(is_held == is_rest || !std::isinf(side));
    }
  }
  const std::vector<char> all(surface.points.size(), 1);
  EXPECT_EQ(cut_into_patches(cover_of(surface), 0.5, all).size(),
            cut_into_patches(cover_of(surface), 0.5).size());
}

/// A surface that is cut along a seam into copies has the rings of the whole one.
TEST(ChooseRings, GoAcrossCopies) {
  const TriMesh whole = sphere();
  TriMesh cut = whole;
  std::vector<Index> origin(whole.points.size());  // of each copy; those of the whole come first
  for (std::size_t p = 0; p < origin.size(); ++p) origin[p] = static_cast<Index>(p);
  std::map<Index, Index> copies;
  for (Triangle& t : cut.triangles) {
    const bool is_right = whole.points[t[0]].x + whole.points[t[1]].x + whole.points[t[2]].x > 0;
    for (Index& p : t) {
      if (!is_right) continue;
      const auto [copy, is_new] = copies.try_emplace(p, static_cast<Index>(origin.size()));
      if (is_new) origin.push_back(p);
      p = copy->second;
    }
  }
  std::vector<char> expected(whole.points.size(), 0), chosen(origin.size(), 0);
  const auto start = static_cast<std::size_t>(
      std::max_element(whole.points.begin(), whole.points.end(),
                       [](const Vec3& a, const Vec3& b) { return -a.x * a.x < -b.x * b.x; }) -
      whole.points.begin());
  expected[start] = chosen[start] = 1;
  choose_rings(whole.triangles, 3, expected);
  choose_rings(cut.triangles, origin, 3, chosen);
  for (std::size_t p = 0; p < chosen.size(); ++p) EXPECT_EQ(chosen[p], expected[origin[p]]) << p;
  EXPECT_GT(std::count(chosen.begin(), chosen.end(), 1),
            std::count(expected.begin(), expected.end(), 1));
}

TEST(Hold, TakesCornersAndRings) {
  const TriMesh surface = sphere();
  Patch patch = cut_into_patches(cover_of(surface), std::numeric_limits<double>::infinity())[0];
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

TEST(ChooseRings, AddsNeighboursRingByRing) {
  const TriMesh surface = sphere();
  std::vector<char> chosen(surface.points.size(), 0);
  chosen[0] = 1;
  std::vector<char> two = chosen;
  choose_rings(surface.triangles, 1, chosen);
  std::set<Index> neighbours;
  for (const Triangle& t : surface.triangles) {
    if (std::count(t.begin(), t.end(), 0) > 0) neighbours.insert(t.begin(), t.end());
  }
  EXPECT_EQ(std::count(chosen.begin(), chosen.end(), 1), std::ssize(neighbours));
  choose_rings(surface.triangles, 1, chosen);
  choose_rings(surface.triangles, 2, two);
  EXPECT_EQ(two, chosen);
}

}  // namespace
}  // namespace mesamis
