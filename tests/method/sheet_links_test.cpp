// SPDX-License-Identifier: Apache-2.0
#include "mesamis/method/sheet_links.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "mesamis/surface/extract_net.h"
#include "mesamis/surface/smooth_memberships.h"
#include "support/label_grids.h"

namespace mesamis {
namespace {

const Vec3 kCenter{9.5, 9.5, 9.5};

template <class LabelAt>
PartitionSurface partition_of(LabelAt&& label_at) {
  const OwnedLabels labels = labels_where({20, 20, 20}, {1, 1, 1}, label_at);
  return extract_net_on_grid(smooth_memberships(labels.grid()));
}

struct Linked {
  PartitionSurface partition;
  Neighbors neighbors;
  std::vector<char> on_curve;
  Links links;

  explicit Linked(PartitionSurface of)
      : partition(std::move(of)),
        neighbors({partition.points, partition.triangles}),
        on_curve(curve_points(partition)),
        links(sheet_links({partition.points, partition.triangles}, partition.sides, on_curve)) {}

  /// The links from curves within the box to points off curves: of the boundary of one material
  /// those that hold, of the others those that do not, and how many there are.
  struct Count {
    int as_expected = 0, all = 0;
  };
  Count links_going_on_along(Index material) const {
    std::vector<char> is_beside(partition.points.size(), 0);
    for (std::size_t t = 0; t < partition.triangles.size(); ++t) {
      if (std::ranges::count(partition.sides[t], material) == 0) continue;
      for (const Index p : partition.triangles[t]) is_beside[p] = 1;
    }
    Count count;
    for (std::size_t p = 0; p < on_curve.size(); ++p) {
      const Vec3 away = partition.points[p] - kCenter;
      const bool inner = std::max({std::abs(away.x), std::abs(away.y), std::abs(away.z)}) < 8.5;
      if (on_curve[p] == 0 || !inner) continue;
      for (std::size_t n = neighbors.start[p]; n < neighbors.start[p + 1]; ++n) {
        const Index q = neighbors.points[n];
        if (on_curve[q] != 0) continue;
        ++count.all;
        count.as_expected += (links[n] & kLinked) == is_beside[q] ? 1 : 0;
      }
    }
    return count;
  }
};

/// The halves of a ball: its own surface goes on, and what parts them ends there.
TEST(SheetLinks, GoOnAlongTheSmoothBoundary) {
  const Linked halves(partition_of([](const Vec3& p) {
    return norm(p - kCenter) > 7 ? 0 : p.x < kCenter.x ? 1 : 2;
  }));
  const auto links = halves.links_going_on_along(0);
  EXPECT_GT(links.all, 200);
  EXPECT_EQ(links.as_expected, links.all);
}

/// Two layers part, slowly: the background between them ends in a cusp.
TEST(SheetLinks, GoOnAlongBothOfTwoThatTouch) {
  const Linked layers(partition_of([](const Vec3& p) {
    const double gap = 0.02 * std::pow(std::max(0.0, p.x - 3), 2);
    return std::abs(p.z - 9.5) < gap ? 0 : p.z < 9.5 ? 1 : 2;
  }));
  int with_both = 0;
  for (std::size_t p = 0; p < layers.on_curve.size(); ++p) {
    int one = 0, other = 0;
    for (std::size_t n = layers.neighbors.start[p]; n < layers.neighbors.start[p + 1]; ++n) {
      one += (layers.links[n] & kLinked) != 0 ? 1 : 0;
      other += (layers.links[n] & kLinkedOther) != 0 ? 1 : 0;
    }
    EXPECT_GT(one, 1);
    if (layers.on_curve[p] == 0) {
      EXPECT_EQ(other, 0);
    } else {
      with_both += other > 1 ? 1 : 0;
    }
  }
  EXPECT_GT(with_both, 20);
}

/// Three equal wedges: none is smoother than the others.
TEST(SheetLinks, KeepToTheCurveWhereNothingGoesOn) {
  const Linked wedges(partition_of([](const Vec3& p) {
    const double turn = std::atan2(p.y - kCenter.y, p.x - kCenter.x + 0.01) / std::numbers::pi + 1;
    return static_cast<int>(std::min(2.0, 1.5 * turn));
  }));
  constexpr Index kNone = 7;  // no boundary goes on
  const auto links = wedges.links_going_on_along(kNone);
  EXPECT_GT(links.all, 100);
  EXPECT_EQ(links.as_expected, links.all);
}

TEST(SheetLinks, LinkEverythingOffCurves) {
  const Linked halves(partition_of([](const Vec3& p) {
    return norm(p - kCenter) > 7 ? 0 : p.x < kCenter.x ? 1 : 2;
  }));
  for (std::size_t p = 0; p < halves.on_curve.size(); ++p) {
    if (halves.on_curve[p] != 0) continue;
    for (std::size_t n = halves.neighbors.start[p]; n < halves.neighbors.start[p + 1]; ++n) {
      EXPECT_EQ(halves.links[n], 1);
    }
  }
}

}  // namespace
}  // namespace mesamis
