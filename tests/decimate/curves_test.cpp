// SPDX-License-Identifier: Apache-2.0
#include "mesamis/decimate/curves.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <map>
#include <set>

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

TEST(Interfaces, PointsWithinCurvesGoOnToTheSameTwoInAll) {
  const Blobs blobs;
  std::map<Index, std::set<Index>> neighbors;
  for_each_at_rim(blobs.surface, [&](Index h) {
    const auto& origin = blobs.interfaces.origin;
    neighbors[origin[blobs.surface.from(h)]].insert(origin[blobs.surface.to(h)]);
    neighbors[origin[blobs.surface.to(h)]].insert(origin[blobs.surface.from(h)]);
  });
  int within = 0, ends = 0;
  for (std::size_t p = 0; p < blobs.interfaces.origin.size(); ++p) {
    const std::size_t count = neighbors[blobs.interfaces.origin[p]].size();
    if (blobs.interfaces.within_curve[p] != 0) {
      EXPECT_EQ(count, 2u);
      ++within;
    }
    if (count > 2) {
      EXPECT_EQ(blobs.interfaces.within_curve[p], 0);
      ++ends;
    }
  }
  EXPECT_GT(within, 100);
  EXPECT_GT(ends, 10);
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

}  // namespace
}  // namespace mesamis
