// SPDX-License-Identifier: Apache-2.0
#include "mesamis/surface/tri_mesh.h"

#include <gtest/gtest.h>

#include <limits>

#include "mesamis/base/error.h"
#include "mesamis/base/parallel.h"
#include "support/shapes.h"
#include "surface/nested_cubes.h"

namespace mesamis {
namespace {

TEST(CheckSurface, FindsNothingWrongWithACube) {
  const SurfaceCheck check = check_surface(cube({1, 2, 3}, 2));
  EXPECT_TRUE(check.closed());
  EXPECT_TRUE(check.manifold());
  EXPECT_EQ(check.components, 1);
  EXPECT_NEAR(check.volume, 8, 1e-14);
  EXPECT_NEAR(check.area, 24, 1e-14);
}

TEST(SurfaceArea, IsThatOfTheCheck) {
  const TriMesh open{{{0, 0, 0}, {3, 0, 0}, {0, 4, 0}, {0, 0, 2}}, {{0, 1, 2}, {0, 3, 1}}};
  EXPECT_DOUBLE_EQ(surface_area(open), 9);
  EXPECT_EQ(surface_area(open), check_surface(open).area);
  EXPECT_EQ(surface_area({}), 0);
}

TEST(SurfaceVolume, IsThatOfTheCheck) {
  const TriMesh whole = cube({1, 2, 3}, 2);
  EXPECT_EQ(surface_volume(whole), check_surface(whole).volume);
  EXPECT_EQ(surface_volume({}), 0);
}

TEST(CheckSurface, KeepsTheVolumeFarFromTheOrigin) {
  EXPECT_NEAR(check_surface(cube({1e6, -1e6, 1e6}, 1)).volume, 1, 1e-9);
}

TEST(CheckSurface, InsideOutHasNegativeVolume) {
  TriMesh surface = cube();
  for (Triangle& t : surface.triangles) std::swap(t[0], t[1]);
  const SurfaceCheck check = check_surface(surface);
  EXPECT_TRUE(check.manifold());
  EXPECT_NEAR(check.volume, -1, 1e-15);
}

TEST(CheckSurface, TellsIslandsFromCavities) {
  const SurfaceCheck check = check_surface(nested());
  EXPECT_EQ(check.components, 6);
  EXPECT_EQ(check.islands, 4) << "the large cube, the one in its cavity, two beside it";
  EXPECT_EQ(check.cavities, 2);
  EXPECT_EQ(components_text(check), "6 components (4 islands, 2 cavities)");
  EXPECT_EQ(components_text(check_surface(cube())), "1 component (1 island, 0 cavities)");
  TriMesh open = joined(nested(), cube({50, 0, 0}, 1));
  open.triangles.pop_back();
  EXPECT_EQ(check_surface(open).islands, 0);
  EXPECT_EQ(check_surface(open).cavities, 0);
  EXPECT_EQ(components_text(check_surface(open)), "7 components");
}

TEST(CheckSurface, CountsTheRimOfAnOpenCube) {
  TriMesh surface = cube();
  surface.triangles.resize(10);  // the face x = 1 is left out
  const SurfaceCheck check = check_surface(surface);
  EXPECT_EQ(check.open_edges, 4);
  EXPECT_FALSE(check.closed());
  EXPECT_TRUE(check.manifold());
  EXPECT_NEAR(check.area, 5, 1e-14);
}

TEST(CheckSurface, CountsTheSidesOfATurnedTriangle) {
  TriMesh surface = cube();
  std::swap(surface.triangles[4][1], surface.triangles[4][2]);
  const SurfaceCheck check = check_surface(surface);
  EXPECT_EQ(check.misoriented_edges, 3);
  EXPECT_TRUE(check.closed());
  EXPECT_FALSE(check.manifold());
}

TEST(CheckSurface, AMoebiusBandCannotBeOriented) {
  // Five triangles in a row, closed with a twist: one seam, one rim.
  TriMesh surface;
  for (int i = 0; i < 5; ++i) surface.points.push_back({double(i), double(i * i), double(i % 2)});
  for (Index i = 0; i < 5; ++i) {
    const Index a = i, b = (i + 1) % 5, c = (i + 2) % 5;
    surface.triangles.push_back(i % 2 == 0 ? Triangle{a, b, c} : Triangle{b, a, c});
  }
  const SurfaceCheck check = check_surface(surface);
  EXPECT_GE(check.misoriented_edges, 1);
  EXPECT_EQ(check.open_edges, 5);
  EXPECT_EQ(check.nonmanifold_edges, 0);
  EXPECT_EQ(check.nonmanifold_points, 0);
}

/// Points with equal coordinates become one.
TriMesh welded(const TriMesh& surface) {
  TriMesh result;
  std::vector<Index> place;
  for (const Vec3& p : surface.points) {
    std::size_t i = 0;
    while (i < result.points.size() && result.points[i] != p) ++i;
    if (i == result.points.size()) result.points.push_back(p);
    place.push_back(static_cast<Index>(i));
  }
  for (const Triangle& t : surface.triangles) {
    result.triangles.push_back({place[t[0]], place[t[1]], place[t[2]]});
  }
  return result;
}

TEST(CheckSurface, SeesTwoCubesThatShareAnEdge) {
  const SurfaceCheck check = check_surface(welded(joined(cube(), cube({1, 1, 0}))));
  EXPECT_EQ(check.nonmanifold_edges, 1);
  EXPECT_EQ(check.misoriented_edges, 0);
  EXPECT_EQ(check.nonmanifold_points, 0);  // one can walk around the ends of the edge
  EXPECT_EQ(check.components, 1);
  EXPECT_FALSE(check.manifold());
}

TEST(CheckSurface, SeesTwoCubesThatShareAPoint) {
  const SurfaceCheck check = check_surface(welded(joined(cube(), cube({1, 1, 1}))));
  EXPECT_EQ(check.nonmanifold_points, 1);
  EXPECT_EQ(check.nonmanifold_edges, 0);
  EXPECT_EQ(check.components, 2);
  EXPECT_TRUE(check.closed());
  EXPECT_FALSE(check.manifold());
}

TEST(CheckSurface, SeesADoubledTriangle) {
  TriMesh surface = cube();
  surface.triangles.push_back(surface.triangles[0]);
  EXPECT_EQ(check_surface(surface).nonmanifold_edges, 3);
}

TEST(CheckSurface, LeavesDegenerateTrianglesOutOfAllOtherCounts) {
  TriMesh surface = cube();
  surface.triangles.insert(surface.triangles.begin(), {{3, 3, 5}, {1, 1, 1}});
  const SurfaceCheck check = check_surface(surface);
  EXPECT_EQ(check.degenerate_triangles, 2);
  EXPECT_TRUE(check.closed());
  EXPECT_EQ(check.nonmanifold_edges + check.nonmanifold_points + check.misoriented_edges, 0);
  EXPECT_EQ(check.components, 1);
  EXPECT_NEAR(check.volume, 1, 1e-15);
  EXPECT_FALSE(check.manifold());
}

TEST(CheckSurface, NothingIsClosed) {
  const SurfaceCheck check = check_surface({});
  EXPECT_TRUE(check.closed());
  EXPECT_TRUE(check.manifold());
  EXPECT_EQ(check.components, 0);
  EXPECT_EQ(check.volume, 0);
}

TEST(CheckSurface, RefusesWhatIsNotASurface) {
  for (const Index bad : {Index{8}, Index{-1}, std::numeric_limits<Index>::max()}) {
    TriMesh surface = cube();
    surface.triangles[7][2] = bad;
    EXPECT_THROW(check_surface(surface), InputError) << bad;
  }
  TriMesh surface = cube();
  surface.points[3].y = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(check_surface(surface), InputError);
}

TEST(CheckSurface, HasTheSameBitsForAnyNumberOfThreads) {
  const TriMesh surface = random_triangles(20'000, {1, 1, 1});
  const SurfaceCheck one = with_threads(1, [&] { return check_surface(surface); });
  const SurfaceCheck three = with_threads(3, [&] { return check_surface(surface); });
  EXPECT_EQ(one.volume, three.volume);
  EXPECT_EQ(one.area, three.area);
  EXPECT_EQ(one.components, 20'000);
  EXPECT_EQ(three.open_edges, 60'000);
}

}  // namespace
}  // namespace mesamis
