// SPDX-License-Identifier: Apache-2.0
#include "mesamis/body/rim.h"

#include <gmock/gmock.h>

#include <cmath>

#include "mesamis/base/error.h"
#include "mesamis/base/parallel.h"
#include "support/sampled_volume.h"
#include "support/solids.h"
#include "support/throws.h"

namespace mesamis {
namespace {

using testing::HasSubstr;

constexpr double kRadius = 7.3, kSigma = 0.8, kInside = 1000, kOutside = 50;
constexpr Vec3 kCentre{12, 12, 12};

/// The values across an edge that a scanner blurs: 1 deep inside, 0 outside.
double edge(double signed_distance) {
  return 0.5 * std::erfc(signed_distance / (kSigma * std::sqrt(2)));
}

/// A blurred ball on voxels of 1 mm.
Volume ball_scan(const std::array<Index, 3>& size = {25, 25, 25}) {
  return sampled_volume(size, {1, 1, 1}, [](const Vec3& p) {
    return kOutside + (kInside - kOutside) * edge(norm(p - kCentre) - kRadius);
  });
}

TriMesh ball_at(const Vec3& centre) { return moved(ball_surface(kRadius, 64), centre); }

TEST(RimDepth, IsTwiceTheBlurOfScannerAndVoxel) {
  VoxelGrid grid;
  grid.spacing = {1, 0.5, 2};
  const Vec3 depth = rim_depth(grid, {0, 1.2, 0.75});
  EXPECT_DOUBLE_EQ(depth.x, 2 * 0.5);
  EXPECT_DOUBLE_EQ(depth.y, 2 * 1.3 * 0.5);
  EXPECT_NEAR(depth.z, 2 * std::sqrt(0.75 * 0.75 + 0.25) * 2, 1e-12);
}

/// The whole ball, and the voxels around that interpolation in it needs, have its value.
TEST(FullRim, OfABallIsAsBrightAsItsInside) {
  const TriMesh ball = ball_at(kCentre);
  const Volume scan = ball_scan(), filled = with_full_rim(scan, {&ball, 1}, {1.9, 1.9, 1.9});
  double least = kInside;
  for (std::size_t n = 0; n < scan.voxel_count(); ++n) {
    const auto [i, j, k] = scan.voxel(n);
    const double r = norm(Vec3(i, j, k) - kCentre);
    ASSERT_GE(filled.samples[n], scan.samples[n]);
    if (r < kRadius + 1) least = std::min<double>(least, filled.samples[n]);
    if (std::abs(r - kRadius) > 2) {
      ASSERT_EQ(filled.samples[n], scan.samples[n]);
    }
  }
  EXPECT_GT(least, 0.97 * kInside);
}

TEST(FullRim, OfAThinBrightShellIsNotDimmed) {
  const TriMesh ball = ball_at(kCentre);
  const Volume scan = sampled_volume({25, 25, 25}, {1, 1, 1}, [](const Vec3& p) {
    const double depth = kRadius - norm(p - kCentre);
    return depth < 0 ? 0 : depth < 1 ? kInside : 200;
  });
  const Volume filled = with_full_rim(scan, {&ball, 1}, {2, 2, 2});
  for (std::size_t n = 0; n < scan.voxel_count(); ++n) {
    ASSERT_GE(filled.samples[n], scan.samples[n]);
    ASSERT_LE(filled.samples[n], kInside);
  }
}

/// Two blocks that touch: each keeps its own value up to the boundary that they share.
TEST(FullRim, OfADimObjectDoesNotTakeFromItsBrightNeighbour) {
  const Volume scan = sampled_volume({25, 25, 25}, {1, 1, 1}, [](const Vec3& p) {
    return p.x < 12.5 ? kInside : p.x < 20.5 ? 300.0 : 0.0;
  });
  const std::vector<TriMesh> blocks{brick({{4.5, 4.5, 4.5}, {12.5, 20.5, 20.5}}, {4, 8, 8}),
                                    brick({{12.5, 4.5, 4.5}, {20.5, 20.5, 20.5}}, {4, 8, 8})};
  const std::vector<TriMesh> turned{blocks[1], blocks[0]};
  for (const Vec3& depth : {Vec3{1.5, 1.5, 1.5}, Vec3{0.6, 0.6, 2.4}, Vec3{3, 3, 3}}) {
    for (const auto& order : {blocks, turned}) {
      const Volume filled = with_full_rim(scan, order, depth);
      for (Index i = 13; i <= 20; ++i) EXPECT_EQ(filled.at(i, 12, 12), 300) << i;
      for (Index i = 5; i <= 12; ++i) EXPECT_EQ(filled.at(i, 12, 12), kInside) << i;
    }
  }
}

/// A plate thinner than the depth, in front of something brighter.
TEST(FullRim, OfAThinWallIsNotTakenFromBehindIt) {
  const Volume scan = sampled_volume({25, 25, 25}, {1, 1, 1}, [](const Vec3& p) {
    return p.x < 10.5 ? 0.0 : p.x < 12.5 ? 300.0 : kInside;
  });
  const TriMesh plate = brick({{10.5, 4.5, 4.5}, {12.5, 20.5, 20.5}}, {2, 8, 8});
  const Volume filled = with_full_rim(scan, {&plate, 1}, {3, 3, 3});
  for (Index i = 9; i <= 12; ++i) EXPECT_EQ(filled.at(i, 12, 12), scan.at(i, 12, 12)) << i;
}

/// A column that leaves the scan has no rim there, though it becomes brighter away from the ends.
TEST(FullRim, OfAnObjectIsNoneWhereTheScanEnds) {
  const Volume scan = sampled_volume({25, 25, 13}, {1, 1, 1}, [](const Vec3& p) {
    return std::hypot(p.x - 12, p.y - 12) < kRadius ? 500 - 40 * std::abs(p.z - 6) : 0;
  });
  const TriMesh column =
      moved(revolved({{0, -6}, {kRadius, -6}, {kRadius, 6}, {0, 6}}, 64), {12, 12, 6});
  const Volume filled = with_full_rim(scan, {&column, 1}, {2, 2, 2});
  for (Index k = 0; k < 13; ++k) {
    EXPECT_EQ(filled.at(12, 12, k), scan.at(12, 12, k)) << k;
    EXPECT_NEAR(filled.at(20, 12, k), scan.at(12, 12, k), 1e-3) << k;
  }
}

TEST(FullRim, IsTheSameInAMirroredScanAndForAnyNumberOfThreads) {
  const TriMesh ball = ball_at(kCentre);
  const Volume filled = with_full_rim(ball_scan(), {&ball, 1}, {2, 2, 2});
  Volume turned = ball_scan();
  turned.origin = {5, -3, 30};
  turned.direction = {{Vec3{0, 1, 0}, Vec3{1, 0, 0}, Vec3{0, 0, 1}}};
  TriMesh in_world = ball;
  for (Vec3& p : in_world.points) p = turned.to_world(p);
  for (Triangle& t : in_world.triangles) std::swap(t[1], t[2]);
  const Volume mirrored_fill = with_full_rim(turned, {&in_world, 1}, {2, 2, 2});
  for (std::size_t n = 0; n < filled.samples.size(); ++n) {
    ASSERT_NEAR(mirrored_fill.samples[n], filled.samples[n],
                1e-3 * kInside);  // two triangles may be as near
  }
  const Volume alone = with_threads(1, [&] {
    return with_full_rim(ball_scan(), {&ball, 1}, {2, 2, 2});
  });
  EXPECT_EQ(alone.samples, filled.samples);
}

TEST(FullRim, OfNoDepthOrNoSurfaceIsTheScan) {
  const TriMesh ball = ball_at(kCentre);
  const Volume scan = ball_scan();
  EXPECT_EQ(with_full_rim(scan, {&ball, 1}, {}).samples, scan.samples);
  EXPECT_EQ(with_full_rim(scan, {}, {2, 2, 2}).samples, scan.samples);
}

TEST(FullRim, RefusesANegativeDepth) {
  const TriMesh ball = ball_at(kCentre);
  EXPECT_REFUSED(with_full_rim(ball_scan(), {&ball, 1}, {1, -1, 1}),
                 HasSubstr("expected depths of at least 0 mm, found -1"));
}

}  // namespace
}  // namespace mesamis
