// SPDX-License-Identifier: Apache-2.0
#include "mesamis/decimate/interfaces.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "mesamis/surface/extract_net.h"
#include "mesamis/surface/half_edges.h"
#include "support/label_grids.h"
#include "support/random_memberships.h"
#include "support/throws.h"

namespace mesamis {
namespace {

/// A box of three slabs. Its boundaries: two interfaces inside and three caps.
PartitionSurface slabs() {
  const TetMesh mesh = box_mesh({{0, 0, 0}, {1, 1, 1}}, {3, 3, 6});
  std::vector<std::vector<double>> fields(3);
  for (const Vec3& p : mesh.points) {
    fields[0].push_back(0.31 - p.z);
    fields[1].push_back(0);
    fields[2].push_back(p.z - 0.64);
  }
  return extract_partition(mesh, fields);
}

TEST(Interfaces, AreTheBoundariesCutAlongTheirCurves) {
  const PartitionSurface partition = slabs();
  const Interfaces interfaces = cut_into_interfaces(partition);
  EXPECT_EQ(interfaces.count, 5);
  ASSERT_EQ(interfaces.surface.triangles.size(), partition.triangles.size());
  std::vector<std::set<std::array<Index, 2>>> sides(5);
  for (std::size_t t = 0; t < partition.triangles.size(); ++t) {
    for (std::size_t i = 0; i < 3; ++i) {
      const Index p = interfaces.surface.triangles[t][i];
      EXPECT_EQ(interfaces.origin[p], partition.triangles[t][i]);
      EXPECT_EQ(interfaces.surface.points[p], partition.points[interfaces.origin[p]]);
      sides[interfaces.of_point[p]].insert(partition.sides[t]);
    }
  }
  for (const auto& of_interface : sides) EXPECT_EQ(of_interface.size(), 1u);
}

TEST(Interfaces, KnowTheirRimsAndCopies) {
  const Interfaces interfaces = cut_into_interfaces(slabs());
  std::size_t at_rims = 0;
  for (std::size_t p = 0; p < interfaces.origin.size(); ++p) {
    const double z = interfaces.surface.points[p].z, x = interfaces.surface.points[p].x,
                 y = interfaces.surface.points[p].y;
    const bool at_side = std::min({x, y, 1 - x, 1 - y}) == 0;
    const bool at_curve = at_side && (std::abs(z - 0.31) < 1e-9 || std::abs(z - 0.64) < 1e-9);
    EXPECT_EQ(interfaces.at_rim[p] != 0, at_curve) << x << " " << y << " " << z;
    EXPECT_EQ(interfaces.within_curve[p] != 0, at_curve);  // no curve has an end
    const auto copies = std::ranges::count(interfaces.origin, interfaces.origin[p]);
    EXPECT_EQ(copies, at_curve ? 3 : 1);
    const auto first =
        std::ranges::find(interfaces.origin, interfaces.origin[p]) - interfaces.origin.begin();
    EXPECT_EQ(interfaces.first_copy[p], first);
    at_rims += at_curve ? 1 : 0;
  }
  EXPECT_GT(at_rims, 0u);
}

TEST(Interfaces, AreManifoldForAllLabels) {
  OwnedLabels labels{.size = {7, 7, 7}};
  std::mt19937 generator(5);
  for (int n = 0; n < 343; ++n) {
    labels.labels.push_back(static_cast<std::uint16_t>(generator() % 5));
  }
  const Interfaces interfaces = cut_into_interfaces(
      extract_partition_on_grid(smooth_memberships(labels.grid(), {.most_rounds = 0})));
  EXPECT_TRUE(check_surface(interfaces.surface).manifold());
}

TEST(Interfaces, AreSplitIntoSurfacesOfTheirOwn) {
  const Interfaces interfaces = cut_into_interfaces(slabs());
  const std::vector<TriMesh> split = split_interfaces(interfaces, interfaces.surface.triangles);
  ASSERT_EQ(std::ssize(split), interfaces.count);
  std::size_t points = 0, triangles = 0;
  double area = 0;
  for (const TriMesh& interface : split) {
    const SurfaceCheck check = check_surface(interface);
    EXPECT_TRUE(check.manifold());
    EXPECT_EQ(check.components, 1);
    points += interface.points.size();
    triangles += interface.triangles.size();
    area += check.area;
  }
  EXPECT_EQ(points, interfaces.surface.points.size());
  EXPECT_EQ(triangles, interfaces.surface.triangles.size());
  EXPECT_NEAR(area, 8, 1e-9);  // the cube and two walls in it
  EXPECT_TRUE(split_interfaces(interfaces, {})[0].triangles.empty());
}

TEST(Interfaces, RefuseWhatIsNoPartition) {
  const PartitionSurface good = slabs();
  PartitionSurface bad = good;
  bad.sides.pop_back();
  EXPECT_REFUSED(cut_into_interfaces(bad), testing::HasSubstr("pair of sides"));
  bad = good;
  bad.sides[0] = {7, 9};
  EXPECT_REFUSED(cut_into_interfaces(bad), testing::HasSubstr("sides differ"));
  bad = good;
  std::swap(bad.triangles[0][1], bad.triangles[0][2]);
  EXPECT_REFUSED(cut_into_interfaces(bad), testing::HasSubstr("opposite"));
  bad = good;
  bad.triangles[0][1] = bad.triangles[0][2];
  EXPECT_REFUSED(cut_into_interfaces(bad), testing::HasSubstr("repeated corner"));
  bad.triangles[0][1] = 1 << 30;
  EXPECT_REFUSED(cut_into_interfaces(bad), testing::HasSubstr("point"));
}

/// Of any two copies of a point that one interface has.
TEST(Interfaces, KnowWhereTheyTouchThemselves) {
  const Interfaces found = cut_into_interfaces(extract_net_on_grid(random_grid({6, 5, 6}, 5, 39)));
  std::map<std::pair<Index, Index>, int> copies;  // of an origin in an interface
  for (std::size_t p = 0; p < found.origin.size(); ++p)
    ++copies[{found.origin[p], found.of_point[p]}];
  std::set<Index> touching;
  for (const auto& [place, count] : copies) {
    if (count > 1) touching.insert(place.first);
  }
  EXPECT_FALSE(touching.empty());
  for (std::size_t p = 0; p < found.origin.size(); ++p) {
    EXPECT_EQ(found.touches_itself[p] != 0, touching.count(found.origin[p]) > 0);
  }
}

TEST(Interfaces, KnowThePointsWithinCurves) {
  const auto interfaces = cut_into_interfaces(
      extract_partition_on_grid(smooth_memberships(random_blobs(14, 4, 4).grid())));
  const auto& origin = interfaces.origin;
  std::map<Index, std::set<Index>> neighbors;  // of the partition's points, along curves
  const auto half_edges =
      sorted_half_edges(interfaces.surface.triangles, interfaces.surface.points.size());
  for_each_edge(half_edges, [&](std::span<const HalfEdge> edge) {
    if (edge.size() != 1) return;
    neighbors[origin[edge[0].lo]].insert(origin[edge[0].hi]);
    neighbors[origin[edge[0].hi]].insert(origin[edge[0].lo]);
  });
  int within = 0, ends = 0;
  for (std::size_t p = 0; p < origin.size(); ++p) {
    const std::size_t count = neighbors[origin[p]].size();
    if (interfaces.within_curve[p] != 0) {
      EXPECT_EQ(count, 2u);
      ++within;
    }
    if (count > 2) {
      EXPECT_EQ(interfaces.within_curve[p], 0);
      ++ends;
    }
  }
  EXPECT_GT(within, 100);
  EXPECT_GT(ends, 10);
}

}  // namespace
}  // namespace mesamis
