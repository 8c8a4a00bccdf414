// SPDX-License-Identifier: Apache-2.0
#include "mesamis/decimate/refit.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "mesamis/base/error.h"
#include "mesamis/base/parallel.h"
#include "mesamis/base/single_precision.h"
#include "mesamis/decimate/decimate.h"
#include "mesamis/decimate/round_to_single.h"
#include "mesamis/surface/distance.h"
#include "mesamis/surface/self_intersections.h"
#include "mesamis/surface/triangle_tree.h"
#include "support/level_set.h"

namespace mesamis {
namespace {

constexpr Box kBox{{-1, -1, -1}, {1, 1, 1}};
constexpr double kRadius = 0.8;

template <class Depth>
TriMesh single(Index n, Depth depth) {
  return round_to_single(level_set(kBox, {n, n, n}, depth));
}

TriMesh sphere() {
  return single(24, [](const Vec3& p) { return kRadius - norm(p); });
}

/// Thin walls and bends of all sizes.
TriMesh shells() {
  return single(20, [](const Vec3& p) {
    const double waves =
        0.06 * std::sin(7 * p.x + 1) * std::cos(6 * p.y) + 0.05 * std::sin(8 * p.z);
    return 0.07 - std::abs(norm(p) - 0.6 + waves);
  });
}

/// Decimated, with its points on the original: all triangles lie on the inner side of bends.
TriMesh decimated_onto(const TriMesh& original, double tolerance) {
  TriMesh few = decimate(original, {.tolerance = 0.7 * tolerance});
  const TriangleTree tree(original);
  std::size_t hint = 0;
  for (Vec3& p : few.points) {
    tree.squared_distance_to(p, hint);
    const Corners& t = tree.triangle(hint);
    const auto place = nearest_place(p, t);
    p = rounded(place[0] * t[0] + place[1] * t[1] + place[2] * t[2]);
  }
  return few;
}

double mean_distance(const TriMesh& from, const TriMesh& to) {
  return summarize(distances_to_surface(from.points, to)).mean;
}

void expect_promises_kept(const TriMesh& result, const TriMesh& original, double tolerance) {
  const SurfaceCheck check = check_surface(result);
  EXPECT_TRUE(check.closed());
  EXPECT_TRUE(check.manifold());
  EXPECT_TRUE(find_self_intersections(result).empty());
  EXPECT_LE(max_distance(result, original, tolerance / 100), 1.01 * tolerance);
  EXPECT_LE(max_distance(original, result, tolerance / 100), 1.01 * tolerance);
  for (const Vec3& p : result.points) {
    for (int a = 0; a < 3; ++a) ASSERT_EQ(p[a], static_cast<float>(p[a]));
  }
}

TEST(Refit, ASphereKeepsItsVolume) {
  constexpr double kTolerance = 0.02;
  const TriMesh original = sphere(), few = decimated_onto(original, kTolerance);
  const TriMesh result = refit(few, original, kTolerance);
  expect_promises_kept(result, original, kTolerance);
  EXPECT_EQ(result.triangles, few.triangles);
  EXPECT_LT(mean_distance(original, result), 0.6 * mean_distance(original, few));
  const double volume = check_surface(original).volume;
  const double lost = volume - check_surface(few).volume;
  EXPECT_GT(lost, 0.005 * volume);
  EXPECT_LT(std::abs(volume - check_surface(result).volume), 0.1 * lost);
}

TEST(Refit, ThinWavesKeepWhatDecimationPromised) {
  const TriMesh original = shells();
  for (const double tolerance : {0.01, 0.04}) {
    const TriMesh few = decimate(original, {.tolerance = tolerance});
    const TriMesh result = refit(few, original, tolerance);
    expect_promises_kept(result, original, tolerance);
    EXPECT_NE(result.points, few.points);
    EXPECT_LT(mean_distance(original, result), mean_distance(original, few)) << tolerance;
  }
}

/// What decimation proved only spares searches; where it took all of the tolerance, few of them.
TEST(Refit, IsTheSameWhereItIsKnownWhatTrianglesStandFor) {
  constexpr double kTolerance = 0.03;
  const TriMesh original = shells();
  for (const double share : {0.6, 1.0}) {
    DecimateReport known, unknown;
    const Cover few = decimate_to_cover(original, {.tolerance = share * kTolerance}, &known);
    unknown = known;
    const TriMesh result = refit(few, original, kTolerance, &known);
    expect_promises_kept(result, original, kTolerance);
    const TriMesh same = refit(TriMesh{few.points, few.triangles}, original, kTolerance, &unknown);
    EXPECT_EQ(result.points, same.points) << share;
    EXPECT_NE(result.points, few.points) << share;
    EXPECT_NEAR(known.original_to_result, unknown.original_to_result, 0.004 * kTolerance);
    EXPECT_NEAR(known.result_to_original, unknown.result_to_original, 0.004 * kTolerance);
  }
}

/// As where the box of a scan cuts the object.
TEST(Refit, FlatPartsStayInTheirPlane) {
  const TriMesh original = round_to_single(level_set(
      {{-1, -1, -1}, {1, 1, 0.4}}, {24, 24, 16}, [](const Vec3& p) { return kRadius - norm(p); }));
  const TriMesh few = decimate(original, {.tolerance = 0.02}), result = refit(few, original, 0.02);
  const double top = bounding_box(few.points).hi.z;
  int flat = 0, moved = 0;
  for (std::size_t p = 0; p < few.points.size(); ++p) {
    moved += result.points[p] == few.points[p] ? 0 : 1;
    if (few.points[p].z != top) continue;
    ++flat;
    EXPECT_EQ(result.points[p].z, top);
  }
  EXPECT_GT(flat, 8);
  EXPECT_GT(moved, 8);
  EXPECT_LE(bounding_box(result.points).hi.z, top);
}

/// Two half balls that share a disc: curves where three objects meet stay, and so does the disc.
TEST(Refit, BoundariesOfAPartitionStayTogether) {
  const TriMesh original = sphere();
  PartitionSurface partition{original.points, original.triangles, {}};
  for (const Triangle& t : original.triangles) {
    const double z = original.points[t[0]].z + original.points[t[1]].z + original.points[t[2]].z;
    partition.sides.push_back(z > 0 ? std::array<Index, 2>{1, 0} : std::array<Index, 2>{2, 0});
  }
  PartitionSurface few = partition;
  const PartitionSurface result = refit_partition(few, partition, 0.02);
  EXPECT_EQ(result.points, partition.points) << "it is the original";
  const TriMesh simple = decimate(original, {.tolerance = 0.02});
  few = {simple.points, simple.triangles, {}};
  for (const Triangle& t : simple.triangles) {
    const double z = simple.points[t[0]].z + simple.points[t[1]].z + simple.points[t[2]].z;
    few.sides.push_back(z > 0 ? std::array<Index, 2>{1, 0} : std::array<Index, 2>{2, 0});
  }
  const PartitionSurface moved = refit_partition(few, partition, 0.06);
  std::vector<int> sides(few.points.size(), 0);
  for (std::size_t t = 0; t < few.triangles.size(); ++t) {
    for (const Index p : few.triangles[t]) sides[p] |= few.sides[t][0];
  }
  int at_curve = 0, elsewhere = 0;
  for (std::size_t p = 0; p < sides.size(); ++p) {
    if (sides[p] == 3) {
      ++at_curve;
      EXPECT_EQ(moved.points[p], few.points[p]);
    } else {
      elsewhere += moved.points[p] == few.points[p] ? 0 : 1;
    }
  }
  EXPECT_GT(at_curve, 8);
  EXPECT_GT(elsewhere, 20);
  few.sides.pop_back();
  EXPECT_THROW(refit_partition(few, partition, 0.02), InputError);
}

TEST(Refit, SameBitsForAnyNumberOfThreads) {
  const TriMesh original = shells(), few = decimate(original, {.tolerance = 0.03});
  const auto run = [&] { return refit(few, original, 0.03).points; };
  EXPECT_EQ(with_threads(1, run), with_threads(3, run));
}

}  // namespace
}  // namespace mesamis
