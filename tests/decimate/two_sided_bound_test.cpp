// SPDX-License-Identifier: Apache-2.0
#include "mesamis/decimate/two_sided_bound.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "decimate/collapses.h"
#include "mesamis/decimate/fan_height.h"
#include "mesamis/surface/distance.h"
#include "mesamis/surface/farthest.h"

namespace mesamis {
namespace {

constexpr double kTolerance = 0.04;

double distance_between(const TriMesh& a, const TriMesh& b) {
  return std::max(max_distance(a, b, 1e-3), max_distance(b, a, 1e-3));
}

TriMesh coarse_sphere() {
  return level_set({{-1, -1, -1}, {1, 1, 1}}, {14, 14, 14},
                   [](const Vec3& p) { return 0.8 - norm(p); });
}

/// What was proved of a surface that has changed is true, and stands for all of the original.
void expect_proof_holds(const TwoSidedBound& bound, const Collapses& now, const TriMesh& mesh) {
  const TriMesh result = now.now();
  double to = 0, from = 0;
  std::vector<char> stood(mesh.triangles.size(), 0);
  for (Index t = 0; t < now.surface.count(); ++t) {
    if (now.surface.is_removed(t)) continue;
    to = std::max(to, bound.to_originals_of(t));
    from = std::max(from, bound.from_originals_of(t));
    for (const Index o : bound.originals_of(t)) stood[o] = 1;
  }
  EXPECT_EQ(std::count(stood.begin(), stood.end(), 0), 0) << "every original is stood for";
  EXPECT_LE(std::max(to, from), kTolerance);
  EXPECT_LE(max_distance(result, mesh, 1e-3), to * kDistanceSlack + 1e-3);
  EXPECT_LE(max_distance(mesh, result, 1e-3), from * kDistanceSlack + 1e-3);
}

TEST(TwoSidedBound, AgreesWithTheDistanceOfTheWholeSurfaces) {
  const TriMesh mesh = small_sphere();
  Collapses collapses(mesh);
  const Cover cover = cover_of(mesh);
  const std::vector<char> held(mesh.points.size(), 0);
  TwoSidedBound bound(mesh, cover, held, kTolerance);
  int refused = 0, allowed = 0;
  collapses.for_each(5, [&](Collapse collapse, const TriMesh& after) {
    collapse.height = fan_height(collapses.surface, collapses.points, collapse);
    const double distance = distance_between(after, mesh);
    if (bound.allows(collapses.surface, collapses.points, collapse)) {
      ++allowed;
      EXPECT_LE(distance, kDistanceSlack * kTolerance);
    } else {
      ++refused;
      EXPECT_GE(distance, kTolerance / 1.1);
    }
  });
  EXPECT_GT(refused, 10);
  EXPECT_GT(allowed, 10);
}

TEST(TwoSidedBound, AgreesWithTheDistanceAtRims) {
  Collapses collapses(small_bowl());
  const TriMesh mesh = collapses.now();
  const Cover cover = cover_of(mesh);
  const std::vector<char> held(mesh.points.size(), 0);
  TwoSidedBound bound(mesh, cover, held, kTolerance);
  int refused = 0, allowed = 0;
  collapses.for_each_at_rim([&](Collapse collapse, const TriMesh& after) {
    collapse.height = fan_height(collapses.surface, collapses.points, collapse);
    const double distance = distance_between(after, mesh);
    const bool allows = bound.allows(collapses.surface, collapses.points, collapse);
    (allows ? allowed : refused) += 1;
    if (allows) {
      EXPECT_LE(distance, kDistanceSlack * kTolerance);
    } else {
      EXPECT_GE(distance, kTolerance / 1.1);
    }
  });
  EXPECT_GT(refused, 10);
  EXPECT_GT(allowed, 10);
}

TEST(TwoSidedBound, HoldsThroughManyCollapses) {
  const TriMesh mesh = coarse_sphere();
  Collapses now(mesh);
  const Cover cover = cover_of(mesh);
  const std::vector<char> held(mesh.points.size(), 0);
  TwoSidedBound bound(mesh, cover, held, kTolerance);
  for (int round = 0; round < 3; ++round) {
    for (Index h = 0; h < 3 * now.surface.count(); ++h) {
      if (now.surface.is_removed(h / 3) || !now.surface.may_collapse(h)) continue;
      const Vec3 &a = now.points[now.surface.from(h)], &b = now.points[now.surface.to(h)];
      Collapse collapse;
      describe(now.surface, now.points, h, 0.5 * (a + b), collapse);
      collapse.height = fan_height(now.surface, now.points, collapse);
      if (!bound.allows(now.surface, now.points, collapse)) continue;
      now.surface.collapse(h);
      now.points[collapse.kept] = collapse.place;
      bound.apply(collapse);
    }
  }
  const TriMesh result = now.now();
  EXPECT_LT(result.triangles.size(), mesh.triangles.size() / 3);
  expect_proof_holds(bound, now, mesh);
}

TEST(TwoSidedBound, OfFlipsAgreesWithTheDistanceOfTheWholeSurfaces) {
  const TriMesh mesh = small_sphere();
  Collapses now(mesh);
  const Cover cover = cover_of(mesh);
  TwoSidedBound bound(mesh, cover, std::vector<char>(mesh.points.size(), 0), kTolerance);
  int refused = 0, allowed = 0;
  for (Index h = 0; h < 3 * now.surface.count(); ++h) {
    if (now.surface.opposite(h) < h || !now.surface.may_flip(h)) continue;
    Flip flip = describe_flip(now.surface, now.points, h);
    now.surface.flip(h);
    const double distance = distance_between(now.now(), mesh);
    for (const double height : {flip.height, std::numeric_limits<double>::infinity()}) {
      flip.height = height;
      if (bound.allows(now.surface, flip)) {
        ++allowed;
        EXPECT_LE(distance, kDistanceSlack * kTolerance);
      } else {
        ++refused;
        EXPECT_GE(distance + 1e-3, kTolerance / 1.1);
      }
    }
    now.surface.flip_back(h);
  }
  EXPECT_GT(refused, 10);
  EXPECT_GT(allowed, 10);
}

TEST(TwoSidedBound, HoldsThroughManyFlips) {
  const TriMesh mesh = coarse_sphere();
  Collapses now(mesh);
  const Cover cover = cover_of(mesh);
  TwoSidedBound bound(mesh, cover, std::vector<char>(mesh.points.size(), 0), kTolerance);
  int done = 0;
  for (int round = 0; round < 3; ++round) {
    for (Index h = 0; h < 3 * now.surface.count(); ++h) {
      if (now.surface.opposite(h) < h || !now.surface.may_flip(h)) continue;
      const Flip flip = describe_flip(now.surface, now.points, h);
      now.surface.flip(h);
      if (bound.allows(now.surface, flip)) {
        bound.apply(flip);
        ++done;
      } else {
        now.surface.flip_back(h);
      }
    }
  }
  EXPECT_GT(done, 500);
  expect_proof_holds(bound, now, mesh);
}

/// Triangles that stay are not looked into, but may come to stand for more.
TEST(TwoSidedBound, IsTheSameWhetherItKnowsWhatStays) {
  const TriMesh mesh = coarse_sphere();
  Collapses now(mesh);
  const Cover cover = cover_of(mesh);
  const std::vector<char> none(mesh.points.size(), 0);
  std::vector<char> held = none;
  for (std::size_t p = 0; p < held.size(); ++p) held[p] = mesh.points[p].z > 0 ? 1 : 0;
  TwoSidedBound all(mesh, cover, none, kTolerance), few(mesh, cover, held, kTolerance);
  for (Index h = 0; h < 3 * now.surface.count(); ++h) {
    if (now.surface.is_removed(h / 3) || !now.surface.may_collapse(h)) continue;
    const Index a = now.surface.from(h), b = now.surface.to(h);
    if (held[a] != 0) continue;
    const Vec3 middle = 0.5 * (now.points[a] + now.points[b]);
    Collapse collapse;
    describe(now.surface, now.points, h, held[b] != 0 ? now.points[b] : middle, collapse);
    collapse.height = fan_height(now.surface, now.points, collapse);
    const bool allowed = all.allows(now.surface, now.points, collapse);
    ASSERT_EQ(few.allows(now.surface, now.points, collapse), allowed);
    if (!allowed) continue;
    now.surface.collapse(h);
    now.points[collapse.kept] = collapse.place;
    all.apply(collapse);
    few.apply(collapse);
  }
  int stay_for_more = 0;
  for (Index t = 0; t < now.surface.count(); ++t) {
    if (now.surface.is_removed(t)) continue;
    ASSERT_EQ(few.originals_of(t), all.originals_of(t));
    EXPECT_EQ(few.to_originals_of(t), all.to_originals_of(t));
    EXPECT_EQ(few.from_originals_of(t), all.from_originals_of(t));
    const Triangle k = now.surface.triangle(t);
    const bool stays = held[k[0]] != 0 && held[k[1]] != 0 && held[k[2]] != 0;
    stay_for_more += stays && few.originals_of(t).size() > 1 ? 1 : 0;
  }
  EXPECT_GT(stay_for_more, 0);
}

}  // namespace
}  // namespace mesamis
