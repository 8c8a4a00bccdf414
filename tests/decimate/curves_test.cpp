// SPDX-License-Identifier: Apache-2.0
#include "mesamis/decimate/curves.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <set>

#include "decimate/collapses.h"
#include "mesamis/decimate/collapse_intersections.h"
#include "mesamis/surface/self_intersections.h"
#include "support/label_grids.h"

namespace mesamis {
namespace {

/// Four blobs in a box, and their interfaces as one patch.
struct Blobs {
  Blobs()
      : partition(extract_partition_on_grid(smooth_memberships(random_blobs(14, 4, 4).grid()))),
        interfaces(cut_into_interfaces(partition)),
        patch(cut_into_patches(cover_of(interfaces.surface), kInfinity).front()),
        surface(patch.points.size(), patch.cover.triangles) {}

  static constexpr double kInfinity = std::numeric_limits<double>::infinity();
  PartitionSurface partition;
  Interfaces interfaces;
  Patch patch;
  EditableSurface surface;
};

/// Calls visit(h) for the half-edges at rims.
template <class Visit>
void for_each_at_rim(const EditableSurface& surface, Visit visit) {
  for (Index h = 0; h < 3 * surface.count(); ++h) {
    if (surface.opposite(h) == kNoIndex) visit(h);
  }
}

TEST(Curves, KnowTheHalfEdgesOfAllInterfacesAtAnEdge) {
  const Blobs blobs;
  const Curves curves(blobs.interfaces, blobs.patch);
  std::map<std::set<Index>, std::vector<Index>> expected;
  const auto edge = [&](Index h) {
    return std::set{blobs.interfaces.origin[blobs.surface.from(h)],
                    blobs.interfaces.origin[blobs.surface.to(h)]};
  };
  for_each_at_rim(blobs.surface, [&](Index h) { expected[edge(h)].push_back(h); });
  int seen = 0;
  for_each_at_rim(blobs.surface, [&](Index h) {
    if (!curves.may_go(blobs.surface.from(h)) && !curves.may_go(blobs.surface.to(h))) return;
    EXPECT_EQ(curves.half_edges_at(blobs.surface, h), expected[edge(h)]);
    EXPECT_GE(expected[edge(h)].size(), 3u);
    ++seen;
  });
  EXPECT_GT(seen, 100);
}

TEST(Curves, StayWhereAPatchHoldsACopyOrHasNotAll) {
  Blobs blobs;
  const Curves free(blobs.interfaces, blobs.patch);
  Index moving = 0;
  while (!free.may_go(moving)) ++moving;
  blobs.patch.held[moving] = 1;
  const Curves curves(blobs.interfaces, blobs.patch);
  curves.for_each_copy(moving, [&](Index p) { EXPECT_FALSE(curves.may_go(p)); });

  for (const Patch& patch : cut_into_patches(cover_of(blobs.interfaces.surface), 5)) {
    const Curves part(blobs.interfaces, patch);
    for (Index p = 0; p < std::ssize(patch.points); ++p) {
      if (!part.may_go(p)) continue;
      Index copies = 0;
      part.for_each_copy(p, [&](Index) { ++copies; });
      EXPECT_EQ(copies, std::ranges::count(blobs.interfaces.first_copy,
                                           blobs.interfaces.first_copy[patch.points[p]]));
    }
  }
}

TEST(Curves, CollapseInAllInterfacesAtOnce) {
  Blobs blobs;
  const Curves curves(blobs.interfaces, blobs.patch);
  int done = 0;
  for_each_at_rim(EditableSurface(blobs.surface), [&](Index h) {
    if (blobs.surface.is_removed(h / 3) || blobs.surface.opposite(h) != kNoIndex) return;
    const Index removed = blobs.surface.from(h);
    if (!curves.may_go(removed)) return;
    const std::vector<Index> all = curves.half_edges_at(blobs.surface, h);
    if (!curves.may_collapse(blobs.surface, all, removed)) return;
    for (const Index g : all) {
      blobs.surface.collapse_at_rim(g, curves.copy_at(blobs.surface, g, removed));
    }
    ++done;
  });
  EXPECT_GT(done, 100);
  PartitionSurface now{blobs.partition.points, {}, {}};
  for (Index t = 0; t < blobs.surface.count(); ++t) {
    if (blobs.surface.is_removed(t)) continue;
    const Triangle k = blobs.surface.triangle(t);
    const auto& origin = blobs.interfaces.origin;
    now.triangles.push_back({origin[k[0]], origin[k[1]], origin[k[2]]});
    now.sides.push_back(blobs.partition.sides[static_cast<std::size_t>(t)]);
  }
  const Interfaces again = cut_into_interfaces(now);
  EXPECT_EQ(again.count, blobs.interfaces.count);
  for (const Index m : materials_of(blobs.partition)) {
    const SurfaceCheck before = check_surface(object_surface(blobs.partition, m)),
                       after = check_surface(object_surface(now, m));
    EXPECT_EQ(flaws_of(after), flaws_of(before));
    EXPECT_EQ(after.components, before.components);
  }
}

/// An edge of a curve as two interfaces see it: its points, and theirs.
struct Bend {
  std::array<Index, 2> edge, pair;
  double crease;
  auto key() const { return std::pair{edge, pair}; }
};

std::vector<Bend> bends_of(const Blobs& blobs, const EditableSurface& surface,
                           const std::vector<Vec3>& points) {
  std::map<std::pair<Index, Index>, std::vector<Index>> at_edges;
  const auto& origin = blobs.interfaces.origin;
  for (Index h = 0; h < 3 * surface.count(); ++h) {
    if (surface.is_removed(h / 3) || surface.opposite(h) != kNoIndex) continue;
    at_edges[std::minmax(origin[surface.from(h)], origin[surface.to(h)])].push_back(h);
  }
  const auto normal = [&](Index h) {
    const Triangle t = surface.triangle(h / 3);
    return unit_normal({points[t[0]], points[t[1]], points[t[2]]});
  };
  std::vector<Bend> bends;
  for (const auto& [edge, all] : at_edges) {
    for (const Index g : all) {
      for (const Index h : all) {
        const Index own = blobs.interfaces.of_point[surface.from(g)],
                    other = blobs.interfaces.of_point[surface.from(h)];
        if (own >= other) continue;
        const bool same = origin[surface.from(g)] == origin[surface.from(h)];
        const Vec3 n = normal(g), m = (same ? -1.0 : 1.0) * normal(h);
        bends.push_back({{edge.first, edge.second},
                         {own, other},
                         crease_at(points[surface.from(g)], points[surface.to(g)], n, m)});
      }
    }
  }
  std::sort(bends.begin(), bends.end(),
            [](const Bend& a, const Bend& b) { return a.key() < b.key(); });
  return bends;
}

/// The creases between each two interfaces.
std::map<std::array<Index, 2>, double> creases_of(const std::vector<Bend>& bends) {
  std::map<std::array<Index, 2>, double> creases;
  for (const Bend& bend : bends) creases[bend.pair] += bend.crease;
  return creases;
}

class BlobsWithCurves : public testing::Test {
 protected:
  void TearDown() override { EXPECT_GT(std::min(seen[0], seen[1]), 5) << "of both kinds"; }

  /// Calls visit(collapses, surface after them, its points) for some edges of curves. The kept
  /// point goes a share of the way to the one removed, if it may.
  template <class Visit>
  void for_each_collapse(int step, const std::vector<double>& shares, Visit visit) const {
    for_each_at_rim(blobs.surface, [&](Index h) {
      const Index removed = blobs.surface.from(h), kept = blobs.surface.to(h);
      const std::vector<Index> all = curves.half_edges_at(blobs.surface, h);
      if (h % step != 0 || !curves.may_go(removed) ||
          !curves.may_collapse(blobs.surface, all, removed)) {
        return;
      }
      for (const double share : shares) {
        if (share != 0 && !curves.may_go(kept)) continue;
        const Vec3 place = points[kept] + share * (points[removed] - points[kept]);
        std::vector<Collapse> collapses(all.size());
        EditableSurface after = blobs.surface;
        std::vector<Vec3> moved = points;
        for (std::size_t n = 0; n < all.size(); ++n) {
          const Index copy = curves.copy_at(blobs.surface, all[n], removed);
          describe_at_rim(blobs.surface, points, all[n], copy, place, collapses[n]);
          after.collapse_at_rim(all[n], copy);
          moved[collapses[n].kept] = place;
        }
        visit(collapses, after, moved);
      }
    });
  }

  const Blobs blobs;
  const Curves curves{blobs.interfaces, blobs.patch};
  const std::vector<Vec3>& points = blobs.patch.cover.points;
  const std::vector<Vec3> normals = normals_of(blobs.surface, points);
  const std::vector<Bend> before = bends_of(blobs, blobs.surface, points);
  std::array<int, 2> seen{};  // refused or not
};

TEST_F(BlobsWithCurves, GetCreasesAlongACurveAsSpoilsCurveSays) {
  const auto sums = creases_of(before);
  for_each_collapse(5, {0.0, 0.4},
                    [&](const std::vector<Collapse>& collapses, const EditableSurface& after,
                        const std::vector<Vec3>& moved) {
                      const bool spoils = spoils_curve(blobs.surface, points, normals, collapses);
                      ++seen[spoils ? 1 : 0];
                      // What does not change adds to both sums: growth of a part by a tenth is less of the whole.
                      bool any = false;
                      for (const auto& [pair, crease] : creases_of(bends_of(blobs, after, moved))) {
                        any |= crease > sums.at(pair);
                        if (!spoils) {
                          EXPECT_LE(crease, 1.1 * sums.at(pair) + 1e-9);
                        }
                      }
                      if (spoils) {
                        EXPECT_TRUE(any);
                      }
                    });
}

TEST_F(BlobsWithCurves, GetACreaseBesideACollapseAsBendsCurveSays) {
  for (Index h = 0; h < 3 * blobs.surface.count(); h += 7) {
    const Index removed = blobs.surface.from(h), kept = blobs.surface.to(h);
    if (!blobs.surface.is_inner(removed) || !blobs.surface.may_collapse(h)) continue;
    bool beside = false;
    blobs.surface.for_each_neighbor(removed, [&](Index p) { beside |= curves.holds(p); });
    if (!beside) continue;
    Collapse collapse;
    describe(blobs.surface, points, h, points[kept], collapse);
    EditableSurface after = blobs.surface;
    after.collapse(h);
    const bool bends = bends_curve(blobs.surface, normals, curves, collapse);
    ++seen[bends ? 1 : 0];
    bool any = false;
    const std::vector<Bend> now = bends_of(blobs, after, points);
    ASSERT_EQ(now.size(), before.size());
    for (std::size_t n = 0; n < now.size(); ++n) {
      ASSERT_EQ(now[n].key(), before[n].key());
      any |= before[n].crease == 0 && now[n].crease > 0;
    }
    EXPECT_EQ(any, bends);
  }
}

TEST_F(BlobsWithCurves, IntersectAsASearchOverTheWholeSays) {
  const auto& first = curves.first_copies();
  CollapseIntersections intersections(blobs.surface, points, first);
  for_each_collapse(43, {-4.0, 0.0, 0.4},
                    [&](const std::vector<Collapse>& collapses, const EditableSurface& after,
                        const std::vector<Vec3>& moved) {
                      std::vector<Collapse> alike = collapses;
                      for (Collapse& collapse : alike) collapse.height = Blobs::kInfinity;
                      TriMesh whole{moved, {}};
                      for (Index t = 0; t < after.count(); ++t) {
                        if (after.is_removed(t)) continue;
                        const Triangle k = after.triangle(t);
                        whole.triangles.push_back({first[k[0]], first[k[1]], first[k[2]]});
                      }
                      const bool meets = !find_self_intersections(whole).empty();
                      std::vector<Vec3> now = points;
                      EXPECT_EQ(intersections.occur(blobs.surface, now, alike), meets);
                      EXPECT_EQ(now, points);
                      ++seen[meets ? 1 : 0];
                    });
}

TEST(Curves, JoinNoPointsThatHaveEdgesInOtherPatches) {
  const Blobs blobs;
  int beside = 0;
  for (const Patch& patch : cut_into_patches(cover_of(blobs.interfaces.surface), 5)) {
    const Curves curves(blobs.interfaces, patch);
    const EditableSurface surface(patch.points.size(), patch.cover.triangles);
    std::set<Index> around;
    for (const Triangle& t : patch.around) around.insert(t.begin(), t.end());
    Index other = 0;
    while (other < std::ssize(patch.points) && !curves.may_go(other)) ++other;
    if (other == std::ssize(patch.points)) continue;
    for (Index p = 0; p < std::ssize(patch.points); ++p) {
      if (!curves.holds(p) || around.count(patch.points[p]) == 0) continue;
      EXPECT_FALSE(curves.may_join(surface, p, other));
      EXPECT_FALSE(curves.may_join(surface, other, p));
      ++beside;
    }
  }
  EXPECT_GT(beside, 10);
}

}  // namespace
}  // namespace mesamis
