// SPDX-License-Identifier: Apache-2.0
#include "mesamis/decimate/collapse_intersections.h"

#include <gtest/gtest.h>

#include <limits>

#include "decimate/collapses.h"
#include "mesamis/decimate/fan_height.h"
#include "mesamis/surface/self_intersections.h"
#include "support/shapes.h"

namespace mesamis {
namespace {

TEST(CollapseIntersections, AgreeWithASearchOverTheWholeSurface) {
  // Two shells close together: many collapses of one cut the other.
  TriMesh inner = small_sphere();
  const TriMesh outer = small_sphere();
  for (Vec3& p : inner.points) p = 0.93 * p;
  for (Triangle& t : inner.triangles) std::swap(t[1], t[2]);
  const TriMesh mesh = joined(outer, inner);
  ASSERT_TRUE(find_self_intersections(mesh).empty());
  Collapses collapses(mesh);
  CollapseIntersections intersections(collapses.surface, collapses.points, {});
  int refused = 0, allowed = 0;
  collapses.for_each(3, [&](Collapse collapse, const TriMesh& after) {
    const bool clean = find_self_intersections(after).empty();
    for (const double height : {std::numeric_limits<double>::infinity(),
                                fan_height(collapses.surface, collapses.points, collapse)}) {
      collapse.height = height;
      EXPECT_EQ(!intersections.occur(collapses.surface, collapses.points, {&collapse, 1}), clean)
          << collapse.removed << " onto " << collapse.kept;
    }
    refused += clean ? 0 : 1;
    allowed += clean ? 1 : 0;
  });
  EXPECT_GT(refused, 10);
  EXPECT_GT(allowed, 10);
}

TEST(CollapseIntersections, KnowWhatEarlierCollapsesMoved) {
  const TriMesh mesh = joined(small_sphere(), cube({0.85, -0.1, -0.1}, 0.2));
  ASSERT_TRUE(find_self_intersections(mesh).empty());
  Collapses now(mesh);
  CollapseIntersections intersections(now.surface, now.points, {});
  for (Index h = 0; h < 3 * now.surface.count(); ++h) {
    if (now.surface.is_removed(h / 3) || !now.surface.may_collapse(h)) continue;
    Collapse collapse;
    const Vec3 &a = now.points[now.surface.from(h)], &b = now.points[now.surface.to(h)];
    describe(now.surface, now.points, h, 0.5 * (a + b), collapse);
    collapse.height = std::numeric_limits<double>::infinity();
    if (intersections.occur(now.surface, now.points, {&collapse, 1})) continue;
    now.surface.collapse(h);
    now.points[collapse.kept] = collapse.place;
    intersections.apply(collapse);
  }
  const TriMesh result = now.now();
  EXPECT_LT(result.triangles.size(), mesh.triangles.size() / 4);
  EXPECT_TRUE(find_self_intersections(result).empty());
}

TEST(CollapseIntersections, OfFlipsAgreeWithASearchOverTheWholeSurface) {
  TriMesh inner = small_sphere();
  const TriMesh outer = small_sphere();
  for (Vec3& p : inner.points) p = 0.985 * p;
  for (Triangle& t : inner.triangles) std::swap(t[1], t[2]);
  Collapses now(joined(outer, inner));
  ASSERT_TRUE(find_self_intersections(now.now()).empty());
  CollapseIntersections intersections(now.surface, now.points, {});
  int refused = 0, made = 0;
  for (Index h = 0; h < 3 * now.surface.count(); h += 3) {
    if (!now.surface.may_flip(h)) continue;
    const Flip flip = describe_flip(now.surface, now.points, h);
    now.surface.flip(h);
    const bool clean = find_self_intersections(now.now()).empty();
    EXPECT_EQ(!intersections.occur(now.surface, now.points, flip), clean);
    (clean ? made : refused) += 1;
    if (clean) {
      intersections.apply(flip);
    } else {
      now.surface.flip_back(h);
    }
  }
  EXPECT_GT(refused, 10);
  EXPECT_GT(made, 10);
}

}  // namespace
}  // namespace mesamis
