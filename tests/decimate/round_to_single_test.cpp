// SPDX-License-Identifier: Apache-2.0
#include "mesamis/decimate/round_to_single.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <set>
#include <tuple>

#include "mesamis/base/error.h"
#include "mesamis/decimate/single_places.h"
#include "mesamis/surface/distance.h"
#include "mesamis/surface/self_intersections.h"
#include "support/level_set.h"
#include "support/shapes.h"

namespace mesamis {
namespace {

constexpr Box kBox{{-1, -1, -1}, {1, 1, 1}};

/// A ball of radius 0.8 in n voxels of the given size, somewhere.
TriMesh ball_at(const Vec3& place, double voxel, Index n) {
  TriMesh surface = level_set(kBox, {n, n, n}, [](const Vec3& p) { return 0.8 - norm(p); });
  for (Vec3& p : surface.points) p = place + (0.5 * n * voxel) * p;
  return surface;
}

void expect_single_and_closed(const TriMesh& surface) {
  const SurfaceCheck check = check_surface(surface);
  EXPECT_TRUE(check.closed());
  EXPECT_TRUE(check.manifold());
  std::set<std::tuple<float, float, float>> places;
  for (const Vec3& p : surface.points) {
    const auto x = static_cast<float>(p.x), y = static_cast<float>(p.y),
               z = static_cast<float>(p.z);
    EXPECT_EQ((Vec3{x, y, z}), p);
    EXPECT_FALSE(std::signbit(x) && x == 0);
    EXPECT_TRUE(places.insert({x, y, z}).second) << "two points at one place";
  }
}

TEST(RoundToSingle, ChangesNoConnectivityWhereThereIsRoom) {
  const TriMesh surface = ball_at({100, -200, 300}, 0.5, 12);
  RoundReport report;
  const TriMesh result = round_to_single(surface, &report);
  EXPECT_EQ(result.triangles, surface.triangles);
  EXPECT_EQ(report.collapsed + report.moved + report.flipped + report.flat, 0);
  EXPECT_GT(report.shift, 0);
  EXPECT_LT(report.shift, 3e-5);
  expect_single_and_closed(result);
  EXPECT_TRUE(find_self_intersections(result).empty());
}

TEST(RoundToSingle, StaysClosedWhereVoxelsAreRoundingErrors) {
  // At 1e5 mm numbers are 0.0078 mm apart, at 1e6 0.06.
  for (const double offset : {1e4, 1e5, 1e6}) {
    const TriMesh surface = ball_at({offset, -offset, offset}, 0.01, 40);
    RoundReport report;
    const TriMesh result = round_to_single(surface, &report);
    expect_single_and_closed(result);
    EXPECT_GT(report.collapsed, 0) << offset;
    EXPECT_LT(result.points.size(), surface.points.size());
    EXPECT_EQ(check_surface(result).components, 1);
  }
}

TEST(RoundToSingle, StaysClosedForNoiseOnTheLattice) {
  for (unsigned seed = 1; seed <= 5; ++seed) {
    std::mt19937 generator(seed);
    std::uniform_real_distribution<double> uniform(-1, 1);
    TriMesh surface = level_set(kBox, {8, 8, 8}, [&](const Vec3&) { return uniform(generator); });
    for (Vec3& p : surface.points) p = Vec3{1e5, 1e5, 1e5} + 0.05 * p;
    expect_single_and_closed(round_to_single(surface));
  }
}

TEST(RoundToSingle, PartsWhatIsNoNeighbour) {
  // Two cubes that come to touch: their faces would become one.
  const TriMesh surface = joined(cube({4096, 0, 0}), cube({4097 + 1e-9, 0, 0}));
  RoundReport report;
  const TriMesh result = round_to_single(surface, &report);
  expect_single_and_closed(result);
  EXPECT_EQ(report.moved, 4);
  EXPECT_EQ(result.triangles.size(), surface.triangles.size());
  EXPECT_LT(report.shift, 0.001);
}

TEST(RoundToSingle, TurnsFlatTrianglesAway) {
  // A point in a face of a cube, so near the middle of a side that it falls onto it.
  TriMesh surface = cube({4096, 0, 0});
  ASSERT_EQ(surface.triangles[1], (Triangle{0, 3, 1}));
  surface.points.push_back({4096.5, 1e-60, 0});
  surface.triangles[1] = {0, 3, 8};
  surface.triangles.insert(surface.triangles.end(), {{3, 1, 8}, {1, 0, 8}});
  RoundReport report;
  const TriMesh result = round_to_single(surface, &report);
  expect_single_and_closed(result);
  EXPECT_EQ(report.flipped, 1);
  EXPECT_EQ(report.flat, 0);
  EXPECT_EQ(result.triangles.size(), 14u);
  EXPECT_TRUE(find_self_intersections(result).empty());
}

/// A cube with thin triangles along the diagonal of a face: points, each nearer to it than the
/// last, in the triangles that were left there.
/// @param spread  of the points along the diagonal, about its middle.
/// @param shrink  the distance of each from the diagonal, times that of the last.
TriMesh cube_with_thin_triangles(unsigned seed, double spread, double shrink) {
  TriMesh surface = cube({1000, 0, 0});
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> along(0.5 - spread, 0.5 + spread);
  Index third = surface.triangles[1][2];  // of the triangle at the diagonal
  const Index a = surface.triangles[1][0], b = surface.triangles[1][1];
  const std::array<Vec3, 3> corners{surface.points[a], surface.points[b], surface.points[third]};
  Triangle* last = &surface.triangles[1];
  for (double off = 1e-3; off > 1e-7; off *= shrink) {
    const double s = along(random);
    const Vec3 on = corners[0] + s * (corners[1] - corners[0]);
    const auto next = static_cast<Index>(surface.points.size());
    surface.points.push_back(on + off * (corners[2] - on));
    *last = {next, a, b};
    surface.triangles.insert(surface.triangles.end(), {{third, a, next}, {third, next, b}});
    last = &surface.triangles[1];
    third = next;
  }
  return surface;
}

/// @return what was done to all surfaces.
RoundReport expect_parted(double spread, double shrink) {
  RoundReport all;
  int met = 0;
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const TriMesh surface = cube_with_thin_triangles(seed, spread, shrink);
    EXPECT_TRUE(find_self_intersections(surface).empty());
    TriMesh simply = surface;
    for (Vec3& p : simply.points) p = rounded(p);
    if (!find_self_intersections(simply).empty()) ++met;
    RoundReport report;
    const TriMesh result = round_to_single(surface, &report);
    expect_single_and_closed(result);
    EXPECT_TRUE(find_self_intersections(result).empty()) << "seed " << seed;
    EXPECT_LT(report.shift, 0.01);
    const double fine = 1e-7, most = 1.004 * report.shift + fine;  // as max_distance() knows it
    EXPECT_LE(max_distance(surface, result, fine), most);
    EXPECT_LE(max_distance(result, surface, fine), most);
    all.collapsed += report.collapsed;
    all.flipped += report.flipped;
  }
  EXPECT_GT(met, 5);
  return all;
}

TEST(RoundToSingle, JoinsNeedlesThatWouldMeet) {
  EXPECT_GT(expect_parted(0.00001, 0.5).collapsed, 20);
}

TEST(RoundToSingle, FlipsCapsThatWouldMeet) { EXPECT_GT(expect_parted(0.4, 0.1).flipped, 20); }

TEST(RoundToSingle, PartsCapsAndNeedlesThatWouldMeet) {
  const RoundReport done = expect_parted(0.0001, 0.5);
  EXPECT_GT(done.collapsed, 5);
  EXPECT_GT(done.flipped, 5);
}

TEST(RoundToSingle, LeavesOutWhatCollapsesInAnOpenSurface) {
  TriMesh surface{{{4096, 0, 0}, {4096 + 1e-9, 0, 0}, {4096, 1, 0}, {4097, 1, 0}},
                  {{0, 1, 2}, {1, 3, 2}}};
  const TriMesh result = round_to_single(surface);
  EXPECT_EQ(result.triangles, (std::vector<Triangle>{{1, 3, 2}}));
}

TEST(RoundToSingle, RefusesWhatSinglePrecisionCannotHold) {
  TriMesh surface = cube();
  surface.points[0].x = 1e39;
  EXPECT_THROW(round_to_single(surface), InputError);
}

}  // namespace
}  // namespace mesamis
