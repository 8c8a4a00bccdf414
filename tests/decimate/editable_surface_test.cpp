// SPDX-License-Identifier: Apache-2.0
#include "mesamis/decimate/editable_surface.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

#include "decimate/collapses.h"
#include "support/shapes.h"

namespace mesamis {
namespace {

/// Compares the half-edges with those made anew from the triangles.
void expect_consistent(const Collapses& now) {
  const EditableSurface& surface = now.surface;
  for (Index h = 0; h < 3 * surface.count(); ++h) {
    if (surface.is_removed(h / 3)) continue;
    const Index o = surface.opposite(h);
    if (o == kNoIndex) {
      EXPECT_EQ(surface.leaving(surface.from(h)), h) << "the first at a rim";
      EXPECT_EQ(surface.arriving_at_rim(surface.to(h)), h);
    } else {
      EXPECT_EQ(surface.opposite(o), h);
      EXPECT_EQ(surface.from(o), surface.to(h));
      EXPECT_EQ(surface.to(o), surface.from(h));
    }
    std::set<Index> leaving;
    surface.for_each_leaving(surface.from(h), [&](Index g) {
      EXPECT_EQ(surface.from(g), surface.from(h));
      leaving.insert(g);
    });
    EXPECT_EQ(leaving.count(h), 1u) << "a fan has all triangles of its point";
  }
}

TEST(EditableSurface, LinksTheTrianglesOfAClosedSurface) {
  const TriMesh sphere = small_sphere();
  const Collapses now(sphere);
  EXPECT_EQ(now.now().triangles, sphere.triangles);
  expect_consistent(now);
  for (Index p = 0; p < std::ssize(sphere.points); ++p) EXPECT_TRUE(now.surface.is_inner(p));
}

TEST(EditableSurface, StaysAClosedManifoldOfItsGenusThroughAllCollapses) {
  for (const TriMesh& mesh :
       {small_sphere(), level_set({{-1, -1, -1}, {1, 1, 1}}, {9, 9, 9}, [](const Vec3& p) {
          return 0.3 - std::hypot(std::hypot(p.x, p.y) - 0.6, p.z);
        })}) {
    Collapses now(mesh);
    const auto euler = [](const TriMesh& m) {
      std::set<Index> used;
      for (const Triangle& t : m.triangles) used.insert(t.begin(), t.end());
      return std::ssize(used) - std::ssize(m.triangles) / 2;
    };
    const auto before = euler(mesh);
    std::mt19937 generator(1);
    int done = 0;
    for (int n = 0; n < 20'000; ++n) {
      const auto h =
          static_cast<Index>(generator() % static_cast<unsigned>(3 * now.surface.count()));
      if (now.surface.is_removed(h / 3) || !now.surface.may_collapse(h)) continue;
      now.surface.collapse(h);
      if (++done % 40 == 0) expect_consistent(now);
    }
    const TriMesh left = now.now();
    EXPECT_GT(done, 30);
    EXPECT_LT(left.triangles.size(), 60u);
    EXPECT_EQ(flaws_of(check_surface(left)), "");
    EXPECT_EQ(euler(left), before);
  }
}

TEST(EditableSurface, KeepsItsRimThroughAllCollapses) {
  Collapses now(small_bowl());
  const SurfaceCheck before = check_surface(now.now());
  const auto triangles = std::ssize(now.now().triangles);
  ASSERT_GT(before.open_edges, 20);
  std::mt19937 generator(2);
  int at_rim = 0, inside = 0;
  for (int n = 0; n < 20'000; ++n) {
    const auto h = static_cast<Index>(generator() % static_cast<unsigned>(3 * now.surface.count()));
    if (now.surface.is_removed(h / 3)) continue;
    if (now.surface.opposite(h) == kNoIndex) {
      const Index removed = generator() % 2 == 0 ? now.surface.from(h) : now.surface.to(h);
      if (!now.surface.may_collapse_at_rim(h, removed)) continue;
      now.surface.collapse_at_rim(h, removed);
      ++at_rim;
    } else {
      if (!now.surface.is_inner(now.surface.from(h)) || !now.surface.may_collapse(h)) continue;
      now.surface.collapse(h);
      ++inside;
    }
    expect_consistent(now);
    const SurfaceCheck check = check_surface(now.now());
    EXPECT_TRUE(check.manifold());
    EXPECT_EQ(check.components, 1);
    EXPECT_EQ(check.open_edges, before.open_edges - at_rim);
    EXPECT_EQ(std::ssize(now.now().triangles), triangles - at_rim - 2 * inside);
  }
  EXPECT_GT(at_rim, 10);
  EXPECT_GT(inside, 10);
  EXPECT_LT(now.now().triangles.size(), 10u);
}

TEST(EditableSurface, StaysAManifoldThroughAllFlipsAndGoesBack) {
  for (const TriMesh& mesh : {small_sphere(), small_bowl()}) {
    Collapses now(mesh);
    const SurfaceCheck before = check_surface(now.now());
    std::mt19937 generator(1);
    int done = 0;
    for (int n = 0; n < 3000; ++n) {
      const auto h =
          static_cast<Index>(generator() % static_cast<unsigned>(3 * now.surface.count()));
      if (now.surface.opposite(h) == kNoIndex || !now.surface.may_flip(h)) continue;
      const std::vector<Triangle> was = now.now().triangles;
      const Index right = now.surface.from(EditableSurface::previous(now.surface.opposite(h))),
                  left = now.surface.from(EditableSurface::previous(h));
      now.surface.flip(h);
      EXPECT_EQ(now.surface.from(h), right);
      EXPECT_EQ(now.surface.to(h), left);
      if (++done % 40 == 0) expect_consistent(now);
      if (done % 3 != 0) continue;
      now.surface.flip_back(h);
      EXPECT_EQ(now.now().triangles, was);
    }
    EXPECT_GT(done, 1000);
    const SurfaceCheck after = check_surface(now.now());
    EXPECT_EQ(flaws_of(after), flaws_of(before));
    EXPECT_EQ(after.open_edges, before.open_edges);
    EXPECT_EQ(after.components, before.components);
  }
}

TEST(EditableSurface, RefusesFlipsThatWouldPinch) {
  const TriMesh tetrahedron{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                            {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}};
  const EditableSurface surface(4, tetrahedron.triangles);
  for (Index h = 0; h < 12; ++h) EXPECT_FALSE(surface.may_flip(h));
}

TEST(EditableSurface, KnowsItsRim) {
  TriMesh open = small_sphere();
  const Triangle hole = open.triangles.back();
  open.triangles.pop_back();
  const EditableSurface surface(open.points.size(), open.triangles);
  for (Index p = 0; p < std::ssize(open.points); ++p) {
    EXPECT_EQ(surface.is_inner(p), std::find(hole.begin(), hole.end(), p) == hole.end());
  }
  // From the rim on, the fan of a point has all its triangles.
  int count = 0, seen = 0;
  for (const Triangle& t : open.triangles)
    count += static_cast<int>(std::count(t.begin(), t.end(), hole[0]));
  surface.for_each_leaving(hole[0], [&](Index) { ++seen; });
  EXPECT_EQ(seen, count);
}

TEST(EditableSurface, RefusesWhatWouldPinchATetrahedron) {
  const TriMesh tetrahedron{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                            {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}};
  const EditableSurface surface(4, tetrahedron.triangles);
  for (Index h = 0; h < 12; ++h) EXPECT_FALSE(surface.may_collapse(h));
}

}  // namespace
}  // namespace mesamis
