// SPDX-License-Identifier: Apache-2.0
#include "mesamis/surface/split_edges.h"

#include <gtest/gtest.h>

#include "mesamis/surface/self_intersections.h"
#include "mesamis/surface/tri_mesh.h"
#include "support/shapes.h"

namespace mesamis {
namespace {

double longest_edge(const TriMesh& surface) {
  double most = 0;
  for (const Triangle& t : surface.triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      most = std::max(most, norm(surface.points[t[i]] - surface.points[t[(i + 1) % 3]]));
    }
  }
  return most;
}

TEST(SplitLongEdges, LeavesNoneAndTheSurfaceWhereItIs) {
  for (const double longest : {2.0, 0.8, 0.3, 0.07}) {
    const TriMesh split = split_long_edges(cube(), longest, {1, 1, 1});
    EXPECT_LE(longest_edge(split), longest);
    const SurfaceCheck report = check_surface(split);
    EXPECT_EQ(report.open_edges + report.nonmanifold_edges + report.misoriented_edges, 0);
    EXPECT_NEAR(report.area, 6, 1e-12);
    EXPECT_NEAR(report.volume, 1, 1e-12);
    EXPECT_TRUE(find_self_intersections(split).empty());
  }
}

TEST(SplitLongEdges, MeasuresEdgesInUnits) {
  // Where the unit is long along z, edges along z stay long.
  const TriMesh split = split_long_edges(cube(), 0.3, {1, 1, 10});
  double along_z = 0, along_x = 0;
  for (const Triangle& t : split.triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3 d = split.points[t[i]] - split.points[t[(i + 1) % 3]];
      along_x = std::max(along_x, std::abs(d.x));
      along_z = std::max(along_z, std::abs(d.z));
    }
  }
  EXPECT_LE(along_x, 0.3);
  EXPECT_GT(along_z, 0.9);
}

TEST(SplitLongEdges, LeavesShortEdgesAlone) {
  const TriMesh before = cube();
  const TriMesh after = split_long_edges(before, 2, {1, 1, 1});
  EXPECT_EQ(after.triangles, before.triangles);
  EXPECT_EQ(after.points.size(), before.points.size());
}

}  // namespace
}  // namespace mesamis
