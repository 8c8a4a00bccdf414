// SPDX-License-Identifier: Apache-2.0
#include "mesamis/image/slice_plane.h"

#include <gmock/gmock.h>

#include <cmath>
#include <string>

#include "support/sampled_volume.h"
#include "support/throws.h"

namespace mesamis {
namespace {

using testing::HasSubstr;

Volume volume_along(const Mat3& direction) {
  Volume volume = sampled_volume({5, 7, 9}, {1, 2, 3}, [](const Vec3& p) { return p.x; });
  volume.origin = {10, 20, 30};
  volume.direction = direction;
  return volume;
}

std::string letters_of(const SlicePlane& plane) {
  return {plane.letters.begin(), plane.letters.end()};
}

const Mat3 kTurned{{Vec3{-1, 0, 0}, Vec3{0, 0, -1}, Vec3{0, 1, 0}}};
const Mat3 kCyclic{{Vec3{0, 1, 0}, Vec3{0, 0, 1}, Vec3{1, 0, 0}}};

TEST(SlicePlane, LiesAsRadiologistsLookAtItHoweverTheGridIsStored) {
  for (const Mat3& direction : {Mat3{}, kTurned, kCyclic}) {
    const Volume volume = volume_along(direction);
    EXPECT_EQ(letters_of(slice_plane(volume, 0, nullptr)), "APIS") << "sagittal";
    EXPECT_EQ(letters_of(slice_plane(volume, 1, nullptr)), "RLIS") << "coronal";
    EXPECT_EQ(letters_of(slice_plane(volume, 2, nullptr)), "RLPA") << "axial";
  }
}

TEST(SlicePlane, IsTheNearestOneToThePosition) {
  const Volume volume = volume_along({});
  for (const auto& [position, index] :
       {std::pair{30.0, 0}, {31.4, 0}, {31.6, 1}, {54.0, 8}, {55.4, 8}, {28.6, 0}}) {
    const SlicePlane plane = slice_plane(volume, 2, &position);
    EXPECT_EQ(plane.index, index) << position;
    EXPECT_NEAR(plane.position, 30 + 3 * index, 1e-12);
  }
  EXPECT_EQ(slice_plane(volume, 2, nullptr).index, 4) << "the middle one";
}

TEST(SlicePlane, RefusesAPositionOutsideTheVolume) {
  const Volume volume = volume_along(kTurned);
  for (const double position : {-1e9, 1e9, std::nan("")}) {
    EXPECT_REFUSED(slice_plane(volume, 1, &position), HasSubstr("no slice at y = "));
  }
}

TEST(ToPage, IsAnIsometryThatPutsTheSliceAtDepthZero) {
  for (const Mat3& direction : {Mat3{}, kTurned, kCyclic}) {
    const Volume volume = volume_along(direction);
    for (const int axis : {0, 1, 2}) {
      const SlicePlane plane = slice_plane(volume, axis, nullptr);
      Vec3 in_slice = volume.to_world(0.3 * volume.box().hi);
      const Vec3 a = to_page(volume, plane, in_slice), b = to_page(volume, plane, {3, 5, 8});
      EXPECT_NEAR(norm(a - b), norm(in_slice - Vec3{3, 5, 8}), 1e-12);
      in_slice[axis] = plane.position;
      EXPECT_NEAR(to_page(volume, plane, in_slice).z, 0, 1e-12);
    }
  }
}

TEST(ToPage, RunsToTheRightAndUpward) {
  const Volume volume = volume_along(kCyclic);
  const SlicePlane axial = slice_plane(volume, 2, nullptr);
  const Vec3 origin = to_page(volume, axial, {0, 0, 0});
  EXPECT_NEAR(to_page(volume, axial, {1, 0, 0}).x - origin.x, 1, 1e-12) << "left is on the right";
  EXPECT_NEAR(to_page(volume, axial, {0, -1, 0}).y - origin.y, 1, 1e-12) << "anterior is above";
}

}  // namespace
}  // namespace mesamis
