// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "mesamis/volume_files/read_volume.h"
#include "support/expect_near.h"
#include "support/read_scan.h"
#include "support/temp_folder.h"

namespace mesamis {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

/// A volume of 4 x 3 x 5 short integers, rows of the directions one after another.
struct MghBytes {
  std::int32_t version = 1, frames = 1, type = 4;
  std::int16_t placed = 1;
  std::array<float, 3> spacing{0.5F, 1.25F, 2}, centre{10, 20, 30};
  std::array<float, 9> directions{1, 0, 0, 0, 1, 0, 0, 0, 1};

  std::string bytes() const {
    std::string h;
    for (const std::int32_t n : {version, 4, 3, 5, frames, type, 0}) h += bytes_of(n, true);
    h += bytes_of(placed, true);
    for (const float x : spacing) h += bytes_of(x, true);
    for (const float x : directions) h += bytes_of(x, true);
    for (const float x : centre) h += bytes_of(x, true);
    h.resize(284);
    return h + bytes_of_all(kRamp, true);
  }
};

TEST(Mgh, IsReadPlainAndPacked) {
  const TempFolder folder;
  const MghBytes mgh;
  for (const VolumeFile& file :
       {read(folder, "a.mgh", mgh.bytes()), read(folder, "a.mgz", packed(mgh.bytes()))}) {
    expect_ramp(file.volume);
    EXPECT_EQ(file.format, "MGH");
    expect_near(file.volume.spacing, {0.5, 1.25, 2});
    // The centre lies half of the size from the first voxel; RAS becomes LPS.
    expect_near(file.volume.origin, {-(10 - 1.0), -(20 - 1.875), 30 - 5.0});
    expect_near(file.volume.direction * Vec3{1, 0, 0}, {-1, 0, 0});
    EXPECT_THAT(file.warnings, IsEmpty());
  }
}

TEST(Mgh, WithoutAPlaceIsCoronal) {
  const TempFolder folder;
  MghBytes mgh;
  mgh.placed = 0;
  const VolumeFile file = read(folder, "a.mgh", mgh.bytes());
  expect_near(file.volume.spacing, {1, 1, 1});
  expect_near(file.volume.direction * Vec3{0, 1, 0}, {0, 0, -1});
  EXPECT_THAT(file.warnings, testing::ElementsAre(HasSubstr("no place")));
}

TEST(Mgh, TakesOneOfSeveralFrames) {
  const TempFolder folder;
  MghBytes mgh;
  mgh.frames = 2;
  write_bytes(folder / "a.mgh", mgh.bytes() + bytes_of_all(ramp<std::int16_t>(60, 100), true));
  EXPECT_THAT(complaint(folder / "a.mgh"), HasSubstr("2 volumes"));
  EXPECT_EQ(read_volume(folder / "a.mgh", {.volume = 1}).volume.samples[0], 100);
}

TEST(Mgh, RefusesOtherFiles) {
  const TempFolder folder;
  MghBytes mgh;
  mgh.version = 2;
  EXPECT_THAT(complaint(folder, "a.mgh", mgh.bytes()), HasSubstr("version 1"));
  mgh = {};
  mgh.type = 2;
  EXPECT_THAT(complaint(folder, "a.mgh", mgh.bytes()), HasSubstr("type"));
  mgh = {};
  mgh.spacing[1] = 0;
  EXPECT_THAT(complaint(folder, "a.mgh", mgh.bytes()), HasSubstr("spacing along axis 1"));
  EXPECT_EQ(read_volume(folder / "a.mgh", {.spacing = Vec3{1, 2, 3}}).volume.spacing,
            (Vec3{1, 2, 3}));
  EXPECT_THAT(complaint(folder, "a.mgh", MghBytes{}.bytes().substr(0, 300)), HasSubstr("bytes"));
  EXPECT_NE(complaint(folder, "a.mgz", "x"), "");
}

}  // namespace
}  // namespace mesamis
