// SPDX-License-Identifier: Apache-2.0
#include "mesamis/decimate/rim_walk.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "decimate/collapses.h"
#include "mesamis/decimate/covering.h"
#include "mesamis/surface/farthest.h"

namespace mesamis {
namespace {

constexpr double kReach = 0.1;  // the tolerance

/// A surface to walk on.
struct Ground {
  explicit Ground(TriMesh surface)
      : mesh(std::move(surface)), half_edges(mesh.points.size(), mesh.triangles), tree(mesh) {
    for (const Triangle& t : mesh.triangles) planes.emplace_back(corners_of(mesh, t));
  }
  WalkedSurface walked() const { return {half_edges, planes}; }
  /// The triangle nearest to a point.
  Index nearest(const Vec3& p) const {
    Index best = 0;
    for (Index t = 0; t < std::ssize(planes); ++t) {
      if (squared_distance(p, planes[t].corners()) < squared_distance(p, planes[best].corners()))
        best = t;
    }
    return best;
  }
  TriangleTree tree_of(const std::vector<Index>& some) const {
    std::vector<Corners> corners;
    for (const Index t : some) corners.push_back(planes[t].corners());
    return TriangleTree(std::move(corners));
  }

  TriMesh mesh;
  EditableSurface half_edges;
  TriangleTree tree;
  std::vector<TrianglePlanes> planes;
};

Ground sphere() {
  return Ground(
      level_set({{-1, -1, -1}, {1, 1, 1}}, {6, 6, 6}, [](const Vec3& p) { return 0.8 - norm(p); }));
}

/// Triangles with corners near the sphere, from small ones to some over many of its triangles.
class NearSphere {
 public:
  explicit NearSphere(double largest) : largest_(largest) {}
  Corners next() {
    const Vec3 at = somewhere();
    const double size = largest_ * std::abs(uniform_(generator_));
    Corners t;
    for (Vec3& p : t) {
      p = (0.8 + 0.05 * uniform_(generator_)) * unit_or_zero(at + size * somewhere());
    }
    return t;
  }

 private:
  Vec3 somewhere() {
    return unit_or_zero({uniform_(generator_), uniform_(generator_), uniform_(generator_)});
  }
  double largest_;
  std::mt19937 generator_{3};
  std::uniform_real_distribution<double> uniform_{-1, 1};
};

double distance_to(const Corners& t, const TriangleTree& tree) {
  std::size_t hint = 0;
  return farthest_distance(t, tree, {1e-4, 10}, hint);
}

TEST(RimWalk, IsNeverBelowTheFarthestPoint) {
  const Ground ground = sphere();
  NearSphere triangles(0.5);
  RimWalk walk(kReach);
  int proved = 0, over_many = 0;
  for (int n = 0; n < 3000; ++n) {
    const Corners t = triangles.next();
    const double bound = walk.bound(TrianglePlanes(t), ground.walked(), ground.nearest(t[0]));
    if (std::isinf(bound)) continue;
    ++proved;
    over_many += walk.used(ground.walked()).size() > 6 ? 1 : 0;
    EXPECT_LE(bound, kReach);
    EXPECT_GE(bound * kDistanceSlack + 1e-4, distance_to(t, ground.tree));
  }
  EXPECT_GT(proved, 1000);
  EXPECT_GT(over_many, 100);
}

TEST(RimWalk, ProvesMostOfWhatTheCoveringDoes) {
  const Ground ground = sphere();
  std::vector<const TrianglePlanes*> all;
  for (const TrianglePlanes& t : ground.planes) all.push_back(&t);
  NearSphere triangles(0.3);
  RimWalk walk(kReach);
  Covering covering(kReach);
  int covered = 0, missed = 0;
  for (int n = 0; n < 3000; ++n) {
    const Corners t = triangles.next();
    const bool is_proved =
        std::isfinite(walk.bound(TrianglePlanes(t), ground.walked(), ground.nearest(t[0])));
    const bool is_covered = std::isfinite(covering.bound(t, all));
    covered += is_covered ? 1 : 0;
    missed += is_covered && !is_proved ? 1 : 0;
  }
  EXPECT_GT(covered, 1000);
  EXPECT_LT(missed, covered / 20);
}

TEST(RimWalk, NamesTrianglesThatAreNearAllOfIt) {
  const Ground ground = sphere();
  NearSphere triangles(0.5);
  RimWalk walk(kReach);
  int named = 0;
  for (int n = 0; n < 1000; ++n) {
    const Corners t = triangles.next();
    const double bound = walk.bound(TrianglePlanes(t), ground.walked(), ground.nearest(t[0]));
    if (std::isinf(bound)) continue;
    ++named;
    EXPECT_GE(bound * kDistanceSlack + 1e-4,
              distance_to(t, ground.tree_of(walk.used(ground.walked()))));
  }
  EXPECT_GT(named, 300);
}

/// A plane of fine triangles; one point is lifted.
TriMesh plane_with_bump(double height) {
  constexpr Index kSide = 8;
  TriMesh mesh;
  for (Index j = 0; j <= kSide; ++j) {
    for (Index i = 0; i <= kSide; ++i) {
      mesh.points.push_back({0.5 * i, 0.5 * j, i == 3 && j == 3 ? height : 0});
      if (i == kSide || j == kSide) continue;
      const Index p = j * (kSide + 1) + i, q = p + kSide + 1;
      mesh.triangles.push_back({p, p + 1, q + 1});
      mesh.triangles.push_back({p, q + 1, q});
    }
  }
  return mesh;
}

TEST(RimWalk, LooksAtWhatItGoesRound) {
  const TrianglePlanes large({Vec3{0.3, 0.4, 0}, {3.8, 0.6, 0}, {1.1, 3.7, 0}});
  for (const double height : {0.0, 0.05, 0.4, -0.4}) {
    const Ground ground(plane_with_bump(height));
    RimWalk walk(kReach);
    const double bound = walk.bound(large, ground.walked(), ground.nearest(large.corners()[0]));
    if (std::abs(height) > kReach) {
      EXPECT_TRUE(std::isinf(bound));
    } else {
      EXPECT_GE(bound, height - 1e-12);
      EXPECT_LE(bound, kReach);
      const std::vector<Index>& used = walk.used(ground.walked());
      EXPECT_GT(used.size(), 50u) << "whole triangles among them";
      EXPECT_GE(bound * kDistanceSlack + 1e-4, distance_to(large.corners(), ground.tree_of(used)));
    }
  }
}

TEST(RimWalk, StaysWithMarkedTriangles) {
  const Ground ground(plane_with_bump(0));
  std::vector<Index> marks(ground.mesh.points.size(), 1);
  const TrianglePlanes large({Vec3{0.3, 0.4, 0}, {3.8, 0.6, 0}, {1.1, 3.7, 0}});
  const WalkedSurface some{ground.half_edges, ground.planes, nullptr, marks, 1};
  RimWalk walk(kReach);
  EXPECT_LE(walk.bound(large, some, 0), kReach);
  std::fill(marks.begin() + 40, marks.end(), 0);
  EXPECT_TRUE(std::isinf(walk.bound(large, some, 0)));
  for (const Index t : walk.used(some)) {
    EXPECT_LT(*std::min_element(ground.mesh.triangles[t].begin(), ground.mesh.triangles[t].end()),
              40);
  }
}

TEST(RimWalk, SeesTheSurfaceAfterACollapse) {
  const TriMesh mesh = small_sphere();
  Collapses collapses(mesh);
  const std::vector<TrianglePlanes> unused;
  collapses.for_each(3, [&](const Collapse& collapse, const TriMesh&) {
    EditableSurface after = collapses.surface;
    after.collapse(collapse.half_edge);
    const WalkedSurface walked{collapses.surface, unused, &collapse};
    for (Index h = 0; h < 3 * after.count(); ++h) {
      if (after.is_removed(h / 3)) continue;
      ASSERT_EQ(walked.opposite(h), after.opposite(h));
      ASSERT_EQ(walked.from(h), after.from(h));
    }
  });
}

}  // namespace
}  // namespace mesamis
