// SPDX-License-Identifier: Apache-2.0
#include "mesamis/picture/slice.h"

#include <gmock/gmock.h>

#include <cmath>
#include <string>

#include "support/sampled_volume.h"
#include "support/throws.h"

namespace mesamis {
namespace {

Volume volume_along(const Mat3& direction) {
  Volume volume = sampled_volume({5, 7, 9}, {1, 2, 3}, [](const Vec3& p) { return p.x; });
  volume.origin = {10, 20, 30};
  volume.direction = direction;
  return volume;
}

const Mat3 kTurned{{Vec3{-1, 0, 0}, Vec3{0, 0, -1}, Vec3{0, 1, 0}}};
const Mat3 kCyclic{{Vec3{0, 1, 0}, Vec3{0, 0, 1}, Vec3{1, 0, 0}}};

TEST(SideTicks, AreRoundCoordinatesWhereTheyBelong) {
  for (const Mat3& direction : {Mat3{}, kTurned, kCyclic}) {
    const Volume volume = volume_along(direction);
    for (const int axis : {0, 1, 2}) {
      const SlicePlane plane = slice_plane(volume, axis, nullptr);
      const auto ticks = side_ticks(volume, plane);
      // The body axes along the page's sides: sagittal y z, coronal x z, axial x y.
      const std::array<int, 2> body{axis == 0 ? 1 : 0, axis == 2 ? 1 : 2};
      for (std::size_t side = 0; side < 2; ++side) {
        ASSERT_GE(ticks[side].size(), 2U);
        for (const SideTick& tick : ticks[side]) {
          Vec3 world = volume.to_world(0.5 * volume.box().hi);
          world[body[side]] = std::stod(tick.text);
          const Vec3 page = to_page(volume, plane, world);
          EXPECT_NEAR(side == 0 ? page.x : page.y, tick.at, 1e-9) << tick.text;
        }
      }
    }
  }
}

TEST(SideTicks, LieWithinTheSlice) {
  Volume volume = volume_along({});
  const double c = std::cos(0.4), s = std::sin(0.4);
  volume.direction = {{Vec3{c, -s, 0}, Vec3{s, c, 0}, Vec3{0, 0, 1}}};
  const auto ticks = side_ticks(volume, slice_plane(volume, 2, nullptr));
  const std::array<double, 2> lo{0, -12}, hi{4, 0};  // axial: y runs downwards
  for (std::size_t side = 0; side < 2; ++side) {
    for (const SideTick& tick : ticks[side]) {
      EXPECT_GE(tick.at, lo[side] - 1e-9);
      EXPECT_LE(tick.at, hi[side] + 1e-9);
    }
  }
}

TEST(SliceWindow, LeavesPaddingOutOfHounsfieldUnits) {
  Volume ct = sampled_volume({20, 20, 20}, {1, 1, 1}, [](const Vec3& p) {
    return p.x < 2 ? -3024 : p.x < 10 ? -1000 : 100 * p.x;
  });
  ct.modality = "CT";
  EXPECT_NEAR(slice_window(ct).lo, -1000, 1);
  EXPECT_NEAR(slice_window(ct).hi, 1900, 1);
  ct.modality = "MR";
  EXPECT_NEAR(slice_window(ct).lo, -3024, 1) << "no padding is known there";
  ct.modality = "CT";
  for (float& sample : ct.samples) sample = std::min(sample - 9000, -2000.0F);
  EXPECT_LT(slice_window(ct).lo, slice_window(ct).hi) << "all of it is padding";
}

TEST(Outline, OfATetrahedronIsTheTriangleBetweenItsEdges) {
  const Volume volume = volume_along({});
  const TriMesh tetrahedron{{{0, 0, 0}, {6, 0, 0}, {0, 6, 0}, {0, 0, 84}},
                            {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}};
  const double position = 42;  // halfway up: half as large
  const SlicePlane plane = slice_plane(volume, 2, &position);
  ASSERT_EQ(plane.position, 42);
  const auto segments = outline(volume, plane, tetrahedron);
  ASSERT_EQ(segments.size(), 3u);
  double length = 0;
  for (const auto& [a, b] : segments) {
    length += norm(b - a);
    EXPECT_NEAR(a.z, 0, 1e-12);
    EXPECT_NEAR(b.z, 0, 1e-12);
  }
  EXPECT_NEAR(length, 3 + 3 + 3 * std::sqrt(2), 1e-12);
}

TEST(Outline, IsEmptyBesideTheSurface) {
  const Volume volume = volume_along({});
  const TriMesh triangle{{{0, 0, 0}, {1, 0, 0}, {0, 1, 1}}, {{0, 1, 2}}};
  EXPECT_TRUE(outline(volume, slice_plane(volume, 2, nullptr), triangle).empty());
}

}  // namespace
}  // namespace mesamis
