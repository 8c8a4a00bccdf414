// SPDX-License-Identifier: Apache-2.0
#include "mesamis/object/patient.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "mesamis/base/parallel.h"
#include "mesamis/object/padding.h"
#include "object/object_scenes.h"
#include "support/throws.h"

namespace mesamis {
namespace {

using testing::HasSubstr;

// A trunk on a table, all in mm: an ellipse of 110 x 70 with lungs and spine, in a field of 320 x
// 240. Beside it an arm, on it a fin of 5 mm (an ear) and a sinus behind a thin wall.
constexpr double kMiddleX = 160, kMiddleY = 100;

bool is_trunk(const Vec3& p) {
  return std::hypot((p.x - kMiddleX) / 110, (p.y - kMiddleY) / 70) < 1;
}
bool is_lung(const Vec3& p) {
  return std::hypot((std::abs(p.x - kMiddleX) - 50) / 35, (p.y - kMiddleY) / 45) < 1;
}
bool is_spine(const Vec3& p) { return std::hypot(p.x - kMiddleX, p.y - kMiddleY - 50) < 14; }
bool is_arm(const Vec3& p) { return std::hypot(p.x - 295, p.y - 110) < 18; }
bool is_fin(const Vec3& p) { return std::abs(p.x - 160) < 2.5 && p.y > 8 && p.y < 35 && p.z < 40; }
bool is_sinus(const Vec3& p) { return std::abs(p.x - 190) < 15 && p.y > 43 && p.y < 52; }
/// Two skins of 4 mm around foam; the upper one is touched along a line.
bool is_table(const Vec3& p) {
  const double below = p.y - 170;
  return (below >= 0 && below < 4) || (below >= 34 && below < 38);
}
bool is_patient(const Vec3& p) { return is_trunk(p) || is_arm(p) || is_fin(p); }

double hounsfield(const Vec3& p) {
  if (is_sinus(p)) return -1000;
  if (is_spine(p)) return 600;
  if (is_trunk(p) && is_lung(p)) return -820;
  if (is_patient(p)) return 40;
  if (is_table(p)) return -80;
  const double below = p.y - 170;
  return below > 0 && below < 34 ? -930 : -1000;
}

Volume scene(const VoxelGrid& grid) {
  Volume volume{grid, {}};
  volume.modality = "CT";
  for_each_voxel(grid, [&](const std::array<Index, 3>& v, std::size_t) {
    const Vec3 p{v[0] * grid.spacing.x, v[1] * grid.spacing.y, v[2] * grid.spacing.z};
    volume.samples.push_back(static_cast<float>(hounsfield(p)));
  });
  add_noise(volume, 20);
  return volume;
}

const VoxelGrid kGrid = grid_of({161, 120, 14}, {2, 2, 4});

TEST(FindPatient, LosesNothingOfThePatient) {
  const auto body = find_patient(scene(kGrid));
  ASSERT_TRUE(body);
  const VoxelMask patient = mask_where(kGrid, is_patient);
  EXPECT_EQ(count_missing(patient, dilated(body->mask, kGrid, body->grain)), 0u);
  EXPECT_LT(double(count_missing(patient, body->mask)), 0.001 * double(count_marked(patient)));
}

TEST(FindPatient, LeavesTheTableOut) {
  const auto body = find_patient(scene(kGrid));
  ASSERT_TRUE(body);
  const VoxelMask far = mask_where(kGrid, [](const Vec3& p) { return p.y > 172; });
  for (std::size_t n = 0; n < far.size(); ++n) ASSERT_FALSE(far[n] != 0 && body->mask[n] != 0) << n;
  const double table = double(count_marked(mask_where(kGrid, is_table))) * 16;
  ASSERT_FALSE(body->removed.empty());
  EXPECT_EQ(body->removed[0].what, "table or head rest");
  EXPECT_NEAR(body->removed[0].mm3, table, 0.1 * table);
}

TEST(FindPatient, MeasuresItsVolume) {
  const auto body = find_patient(scene(kGrid));
  ASSERT_TRUE(body);
  const double patient = double(count_marked(mask_where(kGrid, is_patient))) * 16;
  EXPECT_NEAR(body->mm3, patient, 0.02 * patient);
}

/// The same on fine voxels, of which every second one is looked at.
TEST(FindPatient, IsTheSameOnFinerVoxels) {
  const VoxelGrid fine = grid_of({321, 240, 6}, {1, 1, 4});
  const auto body = find_patient(scene(fine));
  ASSERT_TRUE(body);
  EXPECT_EQ(body->grain, 4);
  const VoxelMask patient = mask_where(fine, is_patient);
  EXPECT_EQ(count_missing(patient, dilated(body->mask, fine, 1.5)), 0u);
  const VoxelMask far = mask_where(fine, [](const Vec3& p) { return p.y > 173; });
  for (std::size_t n = 0; n < far.size(); ++n) ASSERT_FALSE(far[n] != 0 && body->mask[n] != 0) << n;
}

/// A volume whose first axis is the third of another one.
template <class Values>
Values turned(const Values& values, const VoxelGrid& from, const VoxelGrid& to) {
  Values result(values.size());
  for_each_voxel(from, [&](const std::array<Index, 3>& v, std::size_t n) {
    result[to.offset(v[2], v[0], v[1])] = values[n];
  });
  return result;
}

TEST(FindPatient, KnowsWhichAxisRunsAlongThePatient) {
  const Volume volume = scene(kGrid);
  Volume other = volume;
  other.size = {kGrid.size[2], kGrid.size[0], kGrid.size[1]};
  other.spacing = {4, 2, 2};
  other.direction = Mat3{{Vec3{0, 1, 0}, Vec3{0, 0, 1}, Vec3{1, 0, 0}}};  // i runs along z
  other.samples = turned(volume.samples, kGrid, other);
  const auto body = find_patient(volume), found = find_patient(other);
  ASSERT_TRUE(body && found);
  EXPECT_EQ(found->mask, turned(body->mask, kGrid, other));
}

TEST(FindPatient, HoldsLungsThatTheBorderCuts) {
  CropRange range;
  range.begin = {55, 20, 0};  // all of it within the trunk
  range.end = {105, 80, 14};
  const Volume part = crop(scene(kGrid), range);
  const auto body = find_patient(part);
  ASSERT_TRUE(body);
  EXPECT_EQ(count_marked(body->mask), body->mask.size());
}

/// Two legs with a web of skin between them that is longer than what hangs on may be.
TEST(FindPatient, HoldsThinPartsInItsHollows) {
  const VoxelGrid grid = grid_of({76, 40, 65}, {2, 2, 2});
  const VoxelMask legs = mask_where(grid, [](const Vec3& p) {
    const bool is_leg = std::hypot(std::abs(p.x - 75) - 35, p.y - 39) < 30;
    return is_leg || (std::abs(p.x - 75) < 35 && std::abs(p.y - 39) < 2);
  });
  Volume volume = volume_of(grid, legs, 40, -1000);
  volume.modality = "CT";
  const auto body = find_patient(volume);
  ASSERT_TRUE(body);
  EXPECT_EQ(count_missing(legs, body->mask), 0u);
  EXPECT_TRUE(body->removed.empty());
}

/// A chest whose wall is thinner than what the opening leaves.
TEST(FindPatient, HoldsThinWallsAroundLungs) {
  const VoxelGrid grid = grid_of({66, 66, 70}, {2, 2, 2});
  const auto from_axis = [](const Vec3& p) { return std::hypot(p.x - 65, p.y - 65); };
  const VoxelMask chest = mask_where(grid, [&](const Vec3& p) { return from_axis(p) < 60; });
  const VoxelMask lung =
      mask_where(grid, [&](const Vec3& p) { return from_axis(p) < 51 && p.z > 20; });
  Volume volume = filled(volume_of(grid, chest, 40, -1000), lung, -820);
  volume.modality = "CT";
  const auto body = find_patient(volume);
  ASSERT_TRUE(body);
  EXPECT_EQ(body->mask, chest);
}

/// Two legs side by side on a table: between them and its skin is a gap that is not theirs.
TEST(FindPatient, LeavesOutTheTableBelowAGap) {
  const VoxelGrid grid = grid_of({100, 50, 65}, {2, 2, 2});
  const VoxelMask legs = mask_where(
      grid, [](const Vec3& p) { return std::hypot(std::abs(p.x - 99) - 30, p.y - 41) < 31; });
  const VoxelMask table = mask_where(grid, [](const Vec3& p) { return p.y >= 72 && p.y < 76; });
  Volume volume = filled(volume_of(grid, legs, 40, -1000), table, 100);
  volume.modality = "CT";
  const auto body = find_patient(volume);
  ASSERT_TRUE(body);
  EXPECT_EQ(count_missing(legs, dilated(body->mask, grid, body->grain)), 0u);
  for_each_voxel(grid, [&](const std::array<Index, 3>& v, std::size_t n) {
    if (table[n] != 0 && std::abs(2 * v[0] - 99) < 12) {
      EXPECT_EQ(body->mask[n], 0) << v[0];
    }
  });
}

TEST(FindPatient, NamesSmallThingsBesideThePatient) {
  Volume volume = scene(kGrid);
  for (Index i = 5; i < 9; ++i) {
    for (Index j = 5; j < 9; ++j) volume.samples[volume.offset(i, j, 7)] = 2000;
  }
  const auto body = find_patient(volume);
  ASSERT_TRUE(body);
  ASSERT_EQ(body->removed.size(), 2u);
  EXPECT_EQ(body->removed[1].what, "other objects");
  EXPECT_EQ(body->removed[1].mm3, 16 * 16);
}

TEST(FindPatient, FindsNoneInMr) {
  Volume volume = scene(kGrid);
  volume.modality = "MR";
  EXPECT_FALSE(find_patient(volume));
}

TEST(FindPatient, FindsNoneInDryBones) {
  Volume volume = scene(kGrid);
  for (float& x : volume.samples) x = x > -300 ? 900 : -1000;
  EXPECT_FALSE(find_patient(volume));
}

/// The rest has the values of tissue and the bone does not; the bone is not to be removed.
TEST(FindPatient, FindsNoneInADryBoneOnARest) {
  Volume volume{kGrid, {}};
  volume.modality = "CT";
  for_each_voxel(kGrid, [&](const std::array<Index, 3>& v, std::size_t) {
    const Vec3 p{v[0] * kGrid.spacing.x, v[1] * kGrid.spacing.y, v[2] * kGrid.spacing.z};
    const double shell = std::abs(norm(Vec3{p.x - 160, p.y - 100, p.z - 26}) - 60);
    const bool is_rest = p.y > 190 && p.y < 215 && p.x > 130 && p.x < 190;
    volume.samples.push_back(shell < 5 ? 900.0F : is_rest ? -120.0F : -1000.0F);
  });
  EXPECT_FALSE(find_patient(volume));
}

TEST(FindPatient, FindsNoneInAirOrInNothing) {
  Volume volume = scene(kGrid);
  std::fill(volume.samples.begin(), volume.samples.end(), -1000.F);
  EXPECT_FALSE(find_patient(volume));
  EXPECT_FALSE(find_patient(VolumeView{}));
}

TEST(FindPatient, HasTheSameMaskForAnyNumberOfThreads) {
  const Volume volume = scene(kGrid);
  const auto mask = [&] { return find_patient(volume)->mask; };
  EXPECT_EQ(with_threads(2, mask), with_threads(1, mask));
}

TEST(WithoutSurroundings, LeavesThePatientAndTakesTheTable) {
  const Volume volume = scene(kGrid);
  const auto body = find_patient(volume);
  ASSERT_TRUE(body);
  const Volume cleared = without_surroundings(volume, *body);
  for_each_voxel(kGrid, [&](const std::array<Index, 3>& v, std::size_t n) {
    const Vec3 p{v[0] * 2.0, v[1] * 2.0, v[2] * 4.0};
    if (is_patient(p)) {
      ASSERT_EQ(cleared.samples[n], volume.samples[n]);
    }
    if (p.y > 190) {
      ASSERT_LE(cleared.samples[n], -1000);
    }
  });
}

TEST(WithoutSurroundings, RefusesTheBodyOfAnotherVolume) {
  const Volume volume = scene(kGrid);
  EXPECT_REFUSED(without_surroundings(volume, Patient{VoxelMask(3), 0, 1, {}}), HasSubstr("mask"));
}

}  // namespace
}  // namespace mesamis
