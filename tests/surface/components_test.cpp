// SPDX-License-Identifier: Apache-2.0
#include "mesamis/surface/components.h"

#include <gtest/gtest.h>

#include "surface/nested_cubes.h"

namespace mesamis {
namespace {

TEST(Components, AreSortedByVolumeAndKnowTheirSizes) {
  // A small cube, a big one and the wall of a cavity in it.
  const TriMesh surface =
      joined(joined(cube({9, 9, 9}, 1), cube({0, 0, 0}, 5)), turned(cube({1, 1, 1}, 2)));
  const SurfaceComponents components = find_components(surface);
  ASSERT_EQ(components.sizes.size(), 3u);
  const std::vector<double> volumes{125, -8, 1}, areas{150, 24, 6};
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(components.sizes[i].triangles, 12);
    EXPECT_NEAR(components.sizes[i].volume, volumes[i], 1e-12);
    EXPECT_NEAR(components.sizes[i].area, areas[i], 1e-12);
  }
  EXPECT_EQ(components.of_triangle[0], 2);
  EXPECT_EQ(components.of_triangle[12], 0);
  EXPECT_EQ(components.of_triangle[24], 1);
}

TEST(Components, SplitIntoSurfacesOfTheirOwn) {
  TriMesh surface = joined(cube({9, 9, 9}, 1), cube({0, 0, 0}, 5));
  surface.points.push_back({7, 7, 7});     // in no triangle
  surface.triangles.push_back({1, 1, 2});  // degenerate
  const std::vector<TriMesh> parts = split_components(surface);
  ASSERT_EQ(parts.size(), 2u);
  for (const TriMesh& part : parts) {
    EXPECT_EQ(part.points.size(), 8u);
    const SurfaceCheck check = check_surface(part);
    EXPECT_TRUE(check.closed() && check.manifold());
    EXPECT_EQ(check.components, 1);
  }
  EXPECT_NEAR(check_surface(parts[0]).volume, 125, 1e-12);
  EXPECT_NEAR(check_surface(parts[1]).volume, 1, 1e-12);
}

TEST(Components, SplitAtASharedPoint) {
  TriMesh surface = joined(cube(), cube({1, 1, 1}));
  for (Triangle& t : surface.triangles) {
    for (Index& p : t) p = p == 8 ? 7 : p;
  }
  const std::vector<TriMesh> parts = split_components(surface);
  ASSERT_EQ(parts.size(), 2u);
  for (const TriMesh& part : parts) EXPECT_TRUE(check_surface(part).manifold());
}

TEST(Components, OfNothingAreNone) { EXPECT_TRUE(split_components({}).empty()); }

}  // namespace
}  // namespace mesamis
