// SPDX-License-Identifier: Apache-2.0
#include "mesamis/fit/surface_moves.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>

#include "mesamis/surface/self_intersections.h"
#include "support/ball_volume.h"
#include "support/level_set.h"

namespace mesamis {
namespace {

const Vec3 kCenter{19.5, 19.5, 19.5};

TriMesh ball(double radius) {
  return level_set({{0, 0, 0}, {39, 39, 39}}, {20, 20, 20},
                   [radius](const Vec3& p) { return radius - norm(p - kCenter); });
}

SplineImage image() { return interpolating_spline(make_ball({.noise = 0, .radius = 11})); }

TEST(SurfaceMoves, StayInTheBox) {
  const SplineImage scan = image();
  const FollowSpace space(scan, 1);
  EXPECT_TRUE(space.on_box({0, 5, 5}));
  EXPECT_FALSE(space.on_box({0.1, 5, 5}));
  const Vec3 shortened = space.within_box({0.4, 5, 5}, {-1, 0, 0});
  EXPECT_NEAR(shortened.x, -0.2, 1e-12) << "half of the way to the box";
  EXPECT_EQ(space.within_box({3, 5, 5}, {-1, 0, 0}).x, -1);
}

TEST(SurfaceMoves, GoNoFartherThanAllowed) {
  const SplineImage scan = image();
  const FollowSpace space(scan, 2);  // a voxel is half a unit long
  EXPECT_EQ(space.step_to({5, 5.1, 5}, {5, 5, 5}, 0.25).y, 5.1 - 5);
  EXPECT_NEAR(norm(space.step_to({7, 8, 9}, {5, 5, 5}, 0.25)), 0.125, 1e-12);
  EXPECT_NEAR(space.step_to({-9, 5, 5}, {0.1, 5, 5}, 0.25).x, -0.05, 1e-12) << "not to the box";
}

TEST(SurfaceMoves, ArePutInSinglePrecisionOnEveryAxis) {
  VoxelGrid grid;
  grid.size = {10, 10, 10};
  grid.spacing = {0.3, 0.7, 1.1};
  const SurfaceSpace space(grid, 1.1);
  for (int i = 1; i < 100; ++i) {
    const Vec3 p = space.as_in_a_file({i / 30.0, i / 7.0, i / 3.0});
    for (const double x : {p.x, p.y, p.z}) EXPECT_EQ(x, static_cast<double>(static_cast<float>(x)));
  }
}

TEST(SurfaceMoves, KnowTheNeighboursOfEachPoint) {
  const TriMesh tetrahedron{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                            {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};
  const Neighbors neighbors(tetrahedron);
  ASSERT_EQ(neighbors.start.size(), 5U);
  for (std::size_t p = 0; p < 4; ++p) {
    EXPECT_EQ(neighbors.start[p + 1] - neighbors.start[p], 3U) << p;
  }
  // Three triangles at one edge, two of which run along it in the same direction.
  const TriMesh book{{{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}},
                     {{0, 1, 2}, {0, 1, 3}, {1, 0, 4}}};
  const Neighbors pages(book);
  const std::vector<Index> of_first(
      pages.points.begin(), pages.points.begin() + static_cast<std::ptrdiff_t>(pages.start[1]));
  EXPECT_EQ(of_first, (std::vector<Index>{1, 4, 2, 3})) << "those of one triangle last";
  EXPECT_TRUE(pages.has(2, 0) && pages.has(3, 1));
  EXPECT_FALSE(pages.has(2, 4));
}

TEST(SurfaceMoves, OffsetsCountWhereTheImageIsSteep) {
  EXPECT_FALSE(image_offset(10, 4, 1).has_value()) << "too flat to tell";
  const auto offset = image_offset(10, 40, 4);
  ASSERT_TRUE(offset.has_value());
  EXPECT_NEAR(offset->distance, 0.25, 1e-12);
  EXPECT_NEAR(offset->noise, 1.1 * 4 / 40, 1e-12);
  EXPECT_NEAR(image_offset(1000, 40, 4)->distance, 0.7, 1e-12) << "no further";
  Offsets offsets(2);
  offsets.set(1, *offset, 40);
  EXPECT_EQ(offsets.weight[0], 0);
  EXPECT_EQ(offsets.weight[1], 1);
  EXPECT_TRUE(count_told(offsets).is_worthwhile());
  EXPECT_FALSE(count_told(Offsets(3)).is_worthwhile()) << "nothing is told";
}

TEST(SurfaceMoves, AreTakenBackWhereTrianglesWouldMeet) {
  const TriMesh surface = ball(11);
  const SplineImage scan = image();
  const FollowSpace space(scan, 1);
  std::vector<Vec3> shifts(surface.points.size());
  const auto far = static_cast<std::size_t>(surface.triangles[0][0]);
  shifts[far] = (25.0 / 11) * (kCenter - surface.points[far]);  // through the ball and out
  const TriMesh moved = moved_without_folds(space, surface, shifts);
  EXPECT_TRUE(find_self_intersections(moved).empty());
  EXPECT_LT(norm(moved.points[far] - surface.points[far]), 20) << "halved at least once";
  TriMesh filed = moved_without_folds(space, surface, shifts, Unfolded::kInFile);
  EXPECT_LT(norm(filed.points[far] - surface.points[far]), 20);
  for (Vec3& p : filed.points) p = space.as_in_a_file(p);
  EXPECT_TRUE(find_self_intersections(filed).empty());
  std::vector<Vec3> small(surface.points.size(), Vec3{0.1, 0, 0});
  const TriMesh shifted = moved_without_folds(space, surface, small);
  EXPECT_EQ(shifted.points[far].x, surface.points[far].x + 0.1) << "what meets nothing stays moved";
}

/// A triangle with its tip at a point, and two others: one in its way, across the axes, and one
/// beyond that.
struct Tip {
  TriMesh surface{{kStart,
                   kStart + Vec3{1, 1, 0.5},
                   kStart + Vec3{1, 1, 1.5},
                   {10, 3, 3},
                   {3, 10, 3},
                   {3, 3, 10},
                   {1, -1, 0},
                   {-1, 1, 0},
                   {0, 0, 1}},
                  {{0, 1, 2}, {3, 4, 5}, {6, 7, 8}}};
  static constexpr Vec3 kStart{11, 11, 11};

  std::vector<Vec3> shifts(const Vec3& way) const {
    std::vector<Vec3> shifts(surface.points.size());
    std::fill_n(shifts.begin(), 3, way);
    return shifts;
  }
  TriMesh at(const Vec3& way) const {
    TriMesh there = surface;
    for (std::size_t p = 0; p < 3; ++p) there.points[p] += way;
    return there;
  }
};

/// So near to a triangle that what single precision takes, or adds, decides whether the tip is in it.
TEST(SurfaceMoves, GoAsFarAsNothingMeetsHereAndInAFile) {
  const SplineImage scan = image();
  const FollowSpace space(scan, 1);
  const Tip tip;
  const auto meets_here = [&](const Vec3& way) {
    return !find_self_intersections(tip.at(way)).empty();
  };
  const auto meets_in_file = [&](const Vec3& way) {
    TriMesh filed = tip.at(way);
    for (Vec3& p : filed.points) p = space.as_in_a_file(p);
    return !find_self_intersections(filed).empty();
  };
  std::mt19937 generator(3);
  std::uniform_real_distribution<double> uniform(-2e-7, 2e-7);
  std::array<std::array<int, 2>, 2> seen{};  // meets here, meets in a file
  for (int trial = 0; trial < 200; ++trial) {
    const Vec3 at{16.0 / 3 + uniform(generator), 16.0 / 3 + uniform(generator),
                  16.0 / 3 + uniform(generator)};
    const Vec3 there = at - Tip::kStart;
    ++seen[meets_here(there) ? 1 : 0][meets_in_file(there) ? 1 : 0];
    for (const Vec3& way : {there, 2 * there}) {  // the second leads there once it is halved
      for (const Unfolded where : {Unfolded::kHereAndInFile, Unfolded::kInFile}) {
        Vec3 farthest = way;
        const auto meets = [&] {
          return meets_in_file(farthest) ||
                 (where == Unfolded::kHereAndInFile && meets_here(farthest));
        };
        while (meets()) farthest = 0.5 * farthest;
        EXPECT_EQ(moved_without_folds(space, tip.surface, tip.shifts(way), where).points,
                  tip.at(farthest).points);
      }
    }
  }
  for (const auto& of_here : seen) {
    for (const int count : of_here) EXPECT_GT(count, 5) << "of each kind";
  }
}

TEST(SurfaceMover, MovesAgainFromWhereverItIsTold) {
  const TriMesh surface = ball(11);
  const SplineImage scan = image();
  const FollowSpace space(scan, 1);
  const auto far = static_cast<std::size_t>(surface.triangles[0][0]);
  std::vector<Vec3> through(surface.points.size()), small(surface.points.size(), {0.1, 0, 0});
  through[far] = (25.0 / 11) * (kCenter - surface.points[far]);
  SurfaceMover mover(space, surface, Unfolded::kHereAndInFile);
  EXPECT_FALSE(mover.move(surface.points, through)) << "a move is taken back";
  EXPECT_EQ(mover.points(), moved_without_folds(space, surface, through).points);
  EXPECT_TRUE(mover.move(surface.points, small));
  const std::vector<Vec3> start = mover.points();
  EXPECT_TRUE(mover.move(mover.points(), small));
  EXPECT_EQ(mover.points()[far], start[far] + small[far]);
  EXPECT_EQ(mover.take_surface().triangles, surface.triangles);
}

/// Two triangles that met before, and one that was moved on to them.
TEST(SurfaceMover, TellsWhatMetBefore) {
  const TriMesh three{{{5, 5, 5},
                       {9, 5, 5},
                       {5, 9, 5},
                       {6, 6, 4},
                       {6, 6, 6},
                       {9, 9, 5},
                       {5, 5, 8},
                       {9, 5, 8},
                       {5, 9, 8}},
                      {{0, 1, 2}, {3, 4, 5}, {6, 7, 8}}};
  const SplineImage scan = image();
  const FollowSpace space(scan, 1);
  SurfaceMover mover(space, three, Unfolded::kInFile);
  std::vector<Vec3> shifts(three.points.size());
  for (std::size_t p = 6; p < 9; ++p) shifts[p] = {0, 0, -3};
  EXPECT_FALSE(mover.move(three.points, shifts));
  EXPECT_EQ(mover.pairs_left(), (std::vector<TrianglePair>{{0, 1}}));
  EXPECT_TRUE(mover.move(mover.points(), std::vector<Vec3>(three.points.size())));
  EXPECT_EQ(mover.pairs_left(), (std::vector<TrianglePair>{{0, 1}}));
}

/// A row of triangles, each of which meets the one behind it once its own move is taken back, before
/// one that stays: more than there are trials. Two that met before are moved apart.
TEST(SurfaceMover, TellsWhatMetBeforeWhereAllMovesAreTakenBack) {
  constexpr int kRow = 100;
  TriMesh surface{{{5, 5, 9}, {9, 5, 9}, {5, 9, 9}, {6, 6, 8}, {6, 6, 10}, {9, 9, 9}},
                  {{0, 1, 2}, {3, 4, 5}}};
  for (int i = 0; i < kRow; ++i) {
    const double x = 0.3 * i;
    const auto first = static_cast<Index>(surface.points.size());
    surface.points.insert(surface.points.end(), {{x, 5, 5}, {x + 0.25, 5.5, 5}, {x, 6, 5}});
    surface.triangles.push_back({first, first + 1, first + 2});
  }
  std::vector<Vec3> shifts(surface.points.size());
  std::fill_n(shifts.begin() + 3, 3, Vec3{20, 20, 0});
  std::fill(shifts.begin() + 6, shifts.end() - 3, Vec3{0.2, 0, 0});
  const SplineImage scan = image();
  const FollowSpace space(scan, 1);
  SurfaceMover mover(space, surface, Unfolded::kInFile);
  EXPECT_FALSE(mover.move(surface.points, shifts));
  EXPECT_EQ(mover.points(), surface.points);
  EXPECT_EQ(mover.pairs_left(), (std::vector<TrianglePair>{{0, 1}}));
}

}  // namespace
}  // namespace mesamis
