// SPDX-License-Identifier: Apache-2.0
#include "mesamis/decimate/collapse_rules.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <limits>
#include <vector>

#include "mesamis/decimate/patch.h"
#include "mesamis/surface/distance.h"
#include "mesamis/surface/self_intersections.h"
#include "support/level_set.h"
#include "support/shapes.h"

namespace mesamis {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// A surface, its half-edges and each collapse of them that keeps it a closed 2-manifold.
class Collapses {
 public:
  explicit Collapses(const TriMesh& surface) : surface_(surface) {
    build_halfedges(surface, {0, 0, 0}, mesh_);
  }
  HalfedgeMesh& mesh() { return mesh_; }

  /// Calls visit(collapse, surface after it) for every step-th half-edge.
  template <class Visit>
  void for_each(int step, Visit visit) {
    for (int h = 0; h < static_cast<int>(mesh_.n_halfedges()); h += step) {
      const OpenMesh::HalfedgeHandle handle(h);
      if (!keeps_manifold(mesh_, handle)) continue;
      const CollapseInfo collapse(mesh_, handle);
      visit(collapse, after(collapse));
    }
  }

 private:
  TriMesh after(const CollapseInfo& collapse) const {
    TriMesh result{surface_.points, {}};
    for (Triangle t : surface_.triangles) {
      std::replace(t.begin(), t.end(), Index{collapse.v0.idx()}, Index{collapse.v1.idx()});
      if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) result.triangles.push_back(t);
    }
    return result;
  }

  const TriMesh& surface_;
  HalfedgeMesh mesh_;
};

bool is_legal(CollapseRule& rule, const CollapseInfo& collapse) {
  return rule.collapse_priority(collapse) > static_cast<float>(CollapseRule::ILLEGAL_COLLAPSE);
}

TriMesh sphere() {
  return level_set({{-1, -1, -1}, {1, 1, 1}}, {5, 5, 5}, [](const Vec3& p) {
    return 0.8 - norm(p + Vec3{0.03, 0.02, 0.01});
  });
}

/// Height over longest side of the flattest triangle.
double flattest(const TriMesh& surface, Index point) {
  double least = kInfinity;
  for (const Triangle& t : surface.triangles) {
    if (std::find(t.begin(), t.end(), point) == t.end()) continue;
    const Vec3 &a = surface.points[t[0]], &b = surface.points[t[1]], &c = surface.points[t[2]];
    const double longest = std::max({norm(b - a), norm(c - b), norm(a - c)});
    least = std::min(least, norm(cross(b - a, c - a)) / (longest * longest));
  }
  return least;
}

TEST(ModFlatness, RefusesTrianglesFlatterThanBefore) {
  TriMesh surface = sphere();
  for (Vec3& p : surface.points) p.z *= 0.01;  // many triangles become flat by a collapse
  Collapses collapses(surface);
  ModFlatness rule(collapses.mesh());
  rule.set_surface(surface);
  int refused = 0, allowed = 0;
  collapses.for_each(1, [&](const CollapseInfo& collapse, const TriMesh& after) {
    const bool legal = is_legal(rule, collapse);
    const double limit = std::min(0.01, flattest(surface, collapse.v0.idx()));
    // Triangles around v1 that the collapse does not touch may be flat already.
    if (legal) {
      EXPECT_GE(flattest(after, collapse.v1.idx()),
                std::min(limit, flattest(surface, collapse.v1.idx())) * (1 - 1e-9));
    }
    refused += !legal;
    allowed += legal;
  });
  EXPECT_GT(refused, 0);
  EXPECT_GT(allowed, 0);
}

TEST(ModIntersection, AgreesWithASearchOverTheWholeSurface) {
  // Two shells close together: many collapses of one cut the other.
  TriMesh inner = sphere(), outer = sphere();
  for (Vec3& p : inner.points) p = 0.93 * p;
  for (Triangle& t : inner.triangles) std::swap(t[1], t[2]);
  const TriMesh surface = joined(outer, inner);
  ASSERT_TRUE(find_self_intersections(surface).empty());
  Collapses collapses(surface);
  ModIntersection rule(collapses.mesh());
  rule.set_surface(surface);
  int refused = 0, allowed = 0;
  collapses.for_each(3, [&](const CollapseInfo& collapse, const TriMesh& after) {
    auto pairs = find_self_intersections(after);
    std::erase_if(pairs, [](const auto& pair) { return pair[0] == pair[1]; });  // no area
    const bool legal = is_legal(rule, collapse);
    EXPECT_EQ(legal, pairs.empty()) << collapse.v0.idx() << " onto " << collapse.v1.idx();
    refused += !legal;
    allowed += legal;
  });
  EXPECT_GT(refused, 10);
  EXPECT_GT(allowed, 10);
}

TEST(ModIntersection, KnowsWhatEarlierCollapsesMoved) {
  TriMesh surface = joined(sphere(), cube({0.85, -0.1, -0.1}, 0.2));
  ASSERT_TRUE(find_self_intersections(surface).empty());
  Collapses collapses(surface);
  HalfedgeMesh& mesh = collapses.mesh();
  ModIntersection rule(mesh);
  rule.set_surface(surface);
  for (int h = 0; h < static_cast<int>(mesh.n_halfedges()); ++h) {
    const OpenMesh::HalfedgeHandle handle(h);
    if (mesh.status(handle).deleted() || !keeps_manifold(mesh, handle)) continue;
    const CollapseInfo collapse(mesh, handle);
    if (!is_legal(rule, collapse)) continue;
    mesh.collapse(handle);
    rule.postprocess_collapse(collapse);
  }
  const TriMesh result{surface.points, remaining_triangles(mesh)};
  EXPECT_LT(result.triangles.size(), surface.triangles.size() / 4);
  auto pairs = find_self_intersections(result);
  std::erase_if(pairs, [](const auto& pair) { return pair[0] == pair[1]; });
  EXPECT_TRUE(pairs.empty());
}

TEST(ModHausdorff, AgreesWithTheDistanceOfTheWholeSurfaces) {
  const TriMesh surface = sphere();
  const TriangleTree tree(surface);
  const DecimateTask task{surface, {&tree, 1}, 0.04, 0, {}};
  Collapses collapses(surface);
  ModHausdorff rule(collapses.mesh());
  const std::vector<Patch> whole = cut_into_patches(surface.points, cover_of(surface), kInfinity);
  rule.set_task(task, surface, whole[0]);
  int refused = 0, allowed = 0;
  collapses.for_each(5, [&](const CollapseInfo& collapse, const TriMesh& after) {
    const double distance =
        std::max(max_distance(after, surface, 1e-3), max_distance(surface, after, 1e-3));
    const bool legal = is_legal(rule, collapse);
    if (legal) {
      EXPECT_LE(distance, kDistanceSlack * task.tolerance);
    } else {
      EXPECT_GE(distance, task.tolerance / kDistanceSlack);
    }
    refused += !legal;
    allowed += legal;
  });
  EXPECT_GT(refused, 10);
  EXPECT_GT(allowed, 10);
}

TEST(ModHausdorff, AllowsAllWithoutATolerance) {
  const TriMesh surface = sphere();
  const TriangleTree tree(surface);
  const DecimateTask task{surface, {&tree, 1}, kInfinity, 0, {}};
  Collapses collapses(surface);
  ModHausdorff rule(collapses.mesh());
  const std::vector<Patch> whole = cut_into_patches(surface.points, cover_of(surface), kInfinity);
  rule.set_task(task, surface, whole[0]);
  collapses.for_each(7, [&](const CollapseInfo& collapse, const TriMesh&) {
    EXPECT_TRUE(is_legal(rule, collapse));
  });
}

}  // namespace
}  // namespace mesamis
