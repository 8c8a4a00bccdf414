// SPDX-License-Identifier: Apache-2.0
#include "mesamis/object/choose_object.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "mesamis/base/parallel.h"
#include "mesamis/image/grey_values.h"
#include "mesamis/method/prepare.h"
#include "mesamis/object/places.h"
#include "mesamis/object/voxel_islands.h"
#include "object/object_scenes.h"
#include "support/ball_volume.h"
#include "support/sampled_volume.h"
#include "support/throws.h"

namespace mesamis {
namespace {

using testing::AllOf;
using testing::HasSubstr;

/// Two balls of 7 mm, 100 in 0, apart.
const VoxelGrid kGrid = grid_of({48, 24, 24});
const Vec3 kLeft{12, 12, 12}, kRight{34, 12, 12};

VoxelMask ball_mask(const Vec3& middle) {
  return mask_where(kGrid, [&](const Vec3& p) { return norm(p - middle) < 7; });
}

Volume two_balls() {
  Volume volume = volume_of(
      kGrid,
      mask_where(kGrid, [](const Vec3& p) { return norm(p - kLeft) < 7 || norm(p - kRight) < 7; }),
      100, 0);
  add_noise(volume, 2);
  return volume;
}

LabelMap marks(const VoxelGrid& grid, const VoxelMask& mask) {
  LabelMap map;
  static_cast<VoxelGrid&>(map) = grid;
  map.layers.emplace_back(mask.begin(), mask.end());
  map.segments = {{"marked", 1, 0, {}}};
  return map;
}

double level_of(const ChosenObject& chosen) { return chosen.level ? chosen.level->value : -1e9; }

LevelSource source_of(const ChosenObject& chosen) {
  return chosen.level ? chosen.level->from : LevelSource::kRun;
}

/// All above the level are in the mask, and all of the mask above.
void expect_only(const ChosenObject& chosen, const VoxelMask& mask, double level) {
  EXPECT_EQ(mask_above(chosen.volume, level), mask);
}

/// What is chosen in place is what choose_object() makes, where that changes no sample.
TEST(ChooseInPlace, IsChooseObjectWithoutTheSamples) {
  const Volume scan = two_balls();
  for (const std::optional<double> level : {std::optional<double>(), std::optional(50.0)}) {
    const ObjectRequest request{.level = level};
    const ChosenObject copied = choose_object(scan, request);
    const auto found = choose_in_place(scan, request);
    ASSERT_TRUE(found);
    EXPECT_TRUE(found->volume.samples.empty());
    EXPECT_EQ(copied.volume.samples, scan.samples);
    EXPECT_EQ(found->volume.size, copied.volume.size);
    EXPECT_EQ(found->volume.modality, copied.volume.modality);
    EXPECT_EQ(level_of(*found), level_of(copied));
    EXPECT_EQ(source_of(*found), source_of(copied));
    EXPECT_EQ(found->crop, copied.crop);
    EXPECT_EQ(surface_warnings(*found, scan, 50), surface_warnings(copied, 50));
  }
}

TEST(ChooseInPlace, IsNotPossibleWhereSamplesChange) {
  const Volume scan = two_balls();
  EXPECT_FALSE(choose_in_place(scan, {.crop = {{0, 0, 0}, {24, 24, 24}}}));
  EXPECT_FALSE(choose_in_place(scan, {.tissue = parse_tissue("dark")}));
  EXPECT_FALSE(choose_in_place(scan, {.mask = marks(kGrid, ball_mask(kLeft))}));
  EXPECT_FALSE(choose_in_place(scan, {.remove = marks(kGrid, ball_mask(kLeft))}));
  EXPECT_FALSE(choose_in_place(scan, {.seeds = {kLeft}}));
  Volume padded = scan;  // a CT whose corners were not measured
  padded.modality = "CT";
  std::fill_n(padded.samples.begin(), 2000, -3024.0F);
  EXPECT_FALSE(choose_in_place(padded, {}));
  EXPECT_REFUSED(choose_in_place(scan, {.surroundings = SurroundingsRule::kRemove}),
                 HasSubstr("expected a patient's body"));
}

TEST(ChooseObject, LeavesAScanAsItIsIfNothingIsAsked) {
  const Volume scan = two_balls();
  const ChosenObject chosen = choose_object(scan, {});
  EXPECT_EQ(chosen.volume.samples, scan.samples);
  EXPECT_FALSE(chosen.level);
  EXPECT_TRUE(chosen.notes.empty());
  EXPECT_TRUE(chosen.warnings.empty());
}

TEST(ChooseObject, OneSeedLeavesItsIslandAlone) {
  for (const Vec3& seed : {kLeft, kRight}) {
    const ChosenObject chosen = choose_object(two_balls(), {.seeds = {seed}});
    ASSERT_TRUE(chosen.level);
    EXPECT_NEAR(level_of(chosen), 50, 5);
    EXPECT_TRUE(chosen.alone);
    expect_only(chosen, ball_mask(seed), level_of(chosen));
  }
}

TEST(ChooseObject, ASeedInACavityCountsForWhatEnclosesIt) {
  Volume scan = two_balls();
  const VoxelMask hollow = mask_where(kGrid, [](const Vec3& p) { return norm(p - kLeft) < 4; });
  for (std::size_t n = 0; n < hollow.size(); ++n) {
    if (hollow[n] != 0) scan.samples[n] = 0;
  }
  const ChosenObject chosen = choose_object(scan, {.level = 50, .seeds = {kLeft}});
  VoxelMask shell = ball_mask(kLeft);
  for (std::size_t n = 0; n < shell.size(); ++n) shell[n] = shell[n] != 0 && hollow[n] == 0;
  expect_only(chosen, shell, 50);
}

TEST(ChooseObject, SeveralSeedsMakeAPartEach) {
  const ChosenObject chosen = choose_object(two_balls(), {.level = 50, .seeds = {kRight, kLeft}});
  ASSERT_TRUE(chosen.parts);
  EXPECT_FALSE(chosen.alone);
  EXPECT_EQ(mask_on(*chosen.parts, {&chosen.parts->segments[0], 1}, kGrid), ball_mask(kRight));
  EXPECT_EQ(mask_on(*chosen.parts, {&chosen.parts->segments[1], 1}, kGrid), ball_mask(kLeft));
}

constexpr double kBoneRadius = 9, kBoneBlur = 0.8;
const Vec3 kDense{14, 14, 14}, kSpongy{46, 14, 14};

/// A ball of dense bone and one of spongy bone, which is dense in its middle alone.
Volume two_bones() {
  Volume scan = sampled_volume({61, 29, 29}, {1, 1, 1}, [&](const Vec3& p) {
    return 50 + 1150 * blurred_ball(norm(p - kDense), kBoneRadius, kBoneBlur) +
           300 * blurred_ball(norm(p - kSpongy), kBoneRadius, kBoneBlur) +
           850 * blurred_ball(norm(p - kSpongy), 1.5, kBoneBlur);
  });
  scan.modality = "CT";
  return scan;
}

TEST(ChooseObject, SeedsSplitBoneOfManyDensitiesWhereEachPlaceHasItsLevel) {
  constexpr double kBall = 4 / 3. * std::numbers::pi * kBoneRadius * kBoneRadius * kBoneRadius;
  const Volume scan = two_bones();
  const auto voxels_of = [&scan](const Vec3& seed, const Vec3& other, bool local) {
    const ChosenObject chosen = choose_object(scan, {.local_level = local, .seeds = {seed, other}});
    return static_cast<double>(
        count_marked(mask_on(*chosen.parts, {chosen.parts->segments.data(), 1}, chosen.volume)));
  };
  EXPECT_NEAR(voxels_of(kDense, kSpongy, true), kBall, 0.05 * kBall);
  EXPECT_NEAR(voxels_of(kSpongy, kDense, true), kBall, 0.1 * kBall);
  EXPECT_LT(voxels_of(kSpongy, kDense, false), 0.1 * kBall);
  const ChosenObject alone = choose_object(scan, {.local_level = true, .seeds = {kSpongy}});
  EXPECT_EQ(alone.volume.at(46, 20, 14), scan.at(46, 20, 14));
  EXPECT_LT(alone.volume.at(14, 14, 14), 100);
}

/// One bone by itself has one density; in the whole scan each place has its level.
TEST(ChooseObject, ACropOfCtIsMeasuredInTheWhole) {
  const ChosenObject spongy =
      choose_object(two_bones(), {.crop = {{31, 0, 0}, {61, 29, 29}}, .local_level = true});
  ASSERT_TRUE(spongy.scan);
  EXPECT_EQ(spongy.scan->level_share, 1);
  EXPECT_NEAR(spongy.scan->object.object.contrast.object, 1200, 120);
  const ChosenObject one =
      choose_object(two_bones(), {.crop = {{31, 0, 0}, {61, 29, 29}}, .level = 200});
  ASSERT_TRUE(one.scan);
  EXPECT_FALSE(one.scan->level_share);
  EXPECT_FALSE(choose_object(two_bones(), {}).scan) << "the whole is measured where it is restored";
  EXPECT_FALSE(choose_object(two_balls(), {.crop = {{0, 0, 0}, {24, 24, 24}}}).scan) << "no CT";
}

TEST(ChooseObject, WithoutASeedAnIslandIsNoPart) {
  Volume scan = two_balls();
  const VoxelMask third = mask_where(kGrid, [](const Vec3& p) { return p.x < 3 && p.y < 3; });
  for (std::size_t n = 0; n < third.size(); ++n) {
    if (third[n] != 0) scan.samples[n] = 100;
  }
  const ChosenObject chosen = choose_object(scan, {.level = 50, .seeds = {kRight, kLeft}});
  for (std::size_t n = 0; n < third.size(); ++n) {
    if (third[n] != 0) {
      ASSERT_LT(chosen.volume.samples[n], 50);
    }
  }
}

TEST(ChooseObject, AMaskLeavesWhatLiesInIt) {
  const Volume scan = two_balls();
  const VoxelMask mask = mask_where(kGrid, [](const Vec3& p) { return norm(p - kLeft) < 6; });
  const ChosenObject chosen = choose_object(scan, {.mask = marks(kGrid, mask), .margin = 3});
  expect_only(chosen, ball_mask(kLeft), 50);
  const VoxelMask near = dilated(mask, kGrid, 3);
  for (std::size_t n = 0; n < near.size(); ++n) {
    if (near[n] != 0) {
      ASSERT_EQ(chosen.volume.samples[n], scan.samples[n]) << "the image alone, here";
    }
  }
}

TEST(ChooseObject, WhatIsMarkedGoesAndTheRestStays) {
  const Volume scan = two_balls();
  const ChosenObject chosen = choose_object(scan, {.remove = marks(kGrid, ball_mask(kLeft))});
  expect_only(chosen, ball_mask(kRight), 50);
  ASSERT_EQ(chosen.removed.size(), 1U);
  EXPECT_EQ(chosen.removed[0].mm3, static_cast<double>(count_marked(ball_mask(kLeft))));
}

TEST(ChooseObject, CropsWhereTheScanIs) {
  const Volume scan = two_balls();
  const CropRange range = box_to_range(scan, "20:47,,", Frame::kLps);
  const ChosenObject chosen = choose_object(scan, {.crop = range, .seeds = {kRight}});
  EXPECT_EQ(chosen.volume.origin, (Vec3{20, 0, 0}));
  EXPECT_EQ(mask_above(chosen.volume, 50), mask_above(crop(scan, range), 50));
  EXPECT_EQ(chosen.crop, range);
}

// A patient of 110 x 70 mm with a spine and a lung, 60 mm above a table.
const VoxelGrid kCtGrid = grid_of({120, 110, 12}, {2, 2, 4});

bool is_patient(const Vec3& p) { return std::hypot((p.x - 120) / 90, (p.y - 90) / 60) < 1; }
bool is_spine(const Vec3& p) { return std::hypot(p.x - 120, p.y - 120) < 16; }
bool is_lung(const Vec3& p) { return std::hypot(p.x - 90, p.y - 80) < 20; }
bool is_table(const Vec3& p) { return p.y > 180 && p.y < 190; }

double hounsfield(const Vec3& p) {
  if (is_spine(p)) return p.z > 24 ? 1200 : 500;  // no two crops are alike
  if (is_lung(p)) return -820;
  if (is_patient(p)) return 40;
  return is_table(p) ? 300 : -1000;
}

Volume ct() {
  Volume volume{kCtGrid, {}};
  volume.modality = "CT";
  for_each_voxel(kCtGrid, [&](const std::array<Index, 3>& v, std::size_t) {
    volume.samples.push_back(static_cast<float>(hounsfield({v[0] * 2.0, v[1] * 2.0, v[2] * 4.0})));
  });
  add_noise(volume, 15);
  return volume;
}

double most_where(const Volume& volume, bool (*is_there)(const Vec3&)) {
  double most = -1e9;
  const VoxelMask there = mask_where(volume, is_there);
  for (std::size_t n = 0; n < there.size(); ++n) {
    if (there[n] != 0) most = std::max<double>(most, volume.samples[n]);
  }
  return most;
}

TEST(ChooseObject, TheTableGoesUnlessItIsKept) {
  const Volume scan = ct();
  const ChosenObject without = choose_object(scan, {});
  EXPECT_LE(most_where(without.volume, is_table), -1000);
  ASSERT_FALSE(without.removed.empty());
  EXPECT_EQ(without.removed[0].what, "table or head rest");
  EXPECT_NEAR(without.removed[0].mm3, 240.0 * 10 * 48, 0.25 * 240 * 10 * 48);
  ASSERT_EQ(without.notes.size(), 1U);
  EXPECT_THAT(without.notes[0], HasSubstr("table or head rest"));
  EXPECT_THAT(without.notes[0], HasSubstr("--keep-surroundings leaves it"));
  for (const std::size_t n : {scan.offset(60, 45, 6), scan.offset(60, 60, 6)}) {
    EXPECT_EQ(without.volume.samples[n], scan.samples[n]) << "the patient stays";
  }
  const ChosenObject with = choose_object(scan, {.surroundings = SurroundingsRule::kKeep});
  EXPECT_EQ(with.volume.samples, scan.samples);
  EXPECT_TRUE(with.removed.empty());
}

TEST(ChooseObject, TheLevelOfACropIsThatOfTheWholeScan) {
  const ChosenObject whole = choose_object(ct(), {});
  const double level = prepare_image(whole.volume, Settings{}).parameters.level;
  const CropRange lower{{0, 0, 0}, {-1, -1, 6}}, upper{{0, 0, 7}, {-1, -1, -1}};
  for (const CropRange& range : {lower, upper}) {
    const ChosenObject part = choose_object(ct(), {.crop = range});
    EXPECT_EQ(source_of(part), LevelSource::kScan);
    EXPECT_NEAR(level_of(part), level, 1e-6);
  }
  const double alone =
      prepare_image(choose_object(crop(ct(), lower), {}).volume, Settings{}).parameters.level;
  EXPECT_GT(std::abs(alone - level), 30) << "or this test shows nothing";
}

TEST(ChooseObject, APartWithoutAirIsStillCt) {
  Volume scan = ct();
  scan.modality = "";
  const ChosenObject part = choose_object(scan, {.crop = {{50, 35, 0}, {70, 55, -1}}});
  EXPECT_EQ(source_of(part), LevelSource::kScan);
  EXPECT_TRUE(is_hounsfield(part.volume));
  EXPECT_NO_THROW(choose_object(scan, {.tissue = parse_tissue("lung")}));
}

TEST(ChooseObject, ALevelThatIsGivenComesFirst) {
  const ChosenObject chosen = choose_object(ct(), {.tissue = parse_tissue("bone"), .level = 333});
  EXPECT_EQ(level_of(chosen), 333);
  EXPECT_EQ(source_of(chosen), LevelSource::kUser);
}

TEST(ChooseObject, OfDarkTissuesOnlyWhatIsInThePatientIsBright) {
  const ChosenObject chosen = choose_object(ct(), {.tissue = parse_tissue("lung")});
  EXPECT_EQ(chosen.kind, TissueKind::kDark);
  EXPECT_NEAR(level_of(chosen), 390, 40) << "mirrored";
  const VoxelMask lung = mask_where(kCtGrid, is_lung);
  EXPECT_EQ(mask_above(chosen.volume, level_of(chosen)), lung);
}

TEST(ChooseObject, ARangeIsBrightWhereSamplesAreWithin) {
  const ChosenObject chosen = choose_object(ct(), {.tissue = parse_tissue("-100:150")});
  EXPECT_EQ(level_of(chosen), 0);
  EXPECT_GT(chosen.volume.samples[chosen.volume.offset(80, 45, 6)], 0) << "soft";
  EXPECT_LT(chosen.volume.samples[chosen.volume.offset(60, 60, 6)], 0) << "spine";
  EXPECT_LT(chosen.volume.samples[chosen.volume.offset(2, 2, 6)], 0) << "air";
}

TEST(ChooseObject, PaddingIsFilledAndToldOf) {
  Volume scan = ct();
  for_each_voxel(kCtGrid, [&](const std::array<Index, 3>& v, std::size_t n) {
    if (std::hypot(v[0] - 60, v[1] - 45) > 52) scan.samples[n] = -3024;
  });
  const ChosenObject chosen = choose_object(scan, {});
  ASSERT_TRUE(chosen.padding);
  EXPECT_EQ(chosen.padding->value, -3024);
  EXPECT_EQ(chosen.padding->filled, -1000);
  EXPECT_EQ(chosen.padding->voxels, count_marked(chosen.unmeasured));
  EXPECT_GE(sample_range(chosen.volume.samples).first, -1100);
  EXPECT_THAT(chosen.notes.at(0), HasSubstr("of -3024"));
}

TEST(ChooseObject, IsTheSameForAnyNumberOfThreads) {
  const ObjectRequest request{.tissue = parse_tissue("bone"), .seeds = {{120, 120, 20}}};
  const auto run = [&request] { return choose_object(ct(), request); };
  const ChosenObject one = with_threads(1, run), two = with_threads(2, run);
  EXPECT_EQ(one.volume.samples, two.volume.samples);
  EXPECT_EQ(level_of(one), level_of(two));
}

/// A scan of two values is likely a label map, but not where labels are beside it.
TEST(ChooseObject, SaysThatAScanIsLikelyALabelMap) {
  const Volume mask = sampled_volume({20, 20, 20}, {1, 1, 1}, [](const Vec3& p) {
    return norm(p - Vec3{10, 10, 10}) < 6 ? 1.0 : 0.0;
  });
  EXPECT_THAT(choose_object(mask, {}).warnings,
              testing::Contains(testing::HasSubstr("likely a label map, which --labels takes")));
  ObjectRequest beside_labels;
  beside_labels.has_labels = true;
  EXPECT_THAT(choose_object(mask, beside_labels).warnings, testing::IsEmpty());
}

TEST(ChooseObject, RefusesInOneLineWhatDoesNotFit) {
  const auto choose = [](const ObjectRequest& request) { choose_object(two_balls(), request); };
  EXPECT_REFUSED(choose({.seeds = {{-50, 0, 0}}}), HasSubstr("expected one within the scan"));
  EXPECT_REFUSED(choose({.level = 50, .seeds = {{23, 1, 1}}}),
                 HasSubstr("seed: expected values above 50 within 3 mm of 23,1,1 (LPS)"));
  EXPECT_REFUSED(choose({.crop = {{0, 0, 0}, {99, 9, 9}}}), HasSubstr("crop"));
  EXPECT_REFUSED(choose({.tissue = parse_tissue("bone")}), HasSubstr("Hounsfield"));
  EXPECT_REFUSED(choose({.surroundings = SurroundingsRule::kRemove}),
                 HasSubstr("remove: expected a patient's body"));
  const LabelMap nothing = marks(kGrid, VoxelMask(kGrid.voxel_count()));
  EXPECT_REFUSED(choose({.remove = nothing}), HasSubstr("remove: expected marks"));
  EXPECT_REFUSED(choose({.mask = nothing}), HasSubstr("mask: expected an object"));
}

/// In the units of the scan, whatever the image's: of a crop, what the crop has.
TEST(ChooseObject, RefusesARangeWithoutASurface) {
  const auto choose = [](const char* range, const CropRange& crop = {}) {
    choose_object(two_balls(), {.crop = crop, .tissue = parse_tissue(range)});
  };
  for (const char* range : {"6000:7000", "6000:", ":-6000"}) {
    EXPECT_REFUSED(choose(range), AllOf(HasSubstr("tissue: expected a range with samples within"),
                                        HasSubstr(std::string("found ") + range)))
        << range;
  }
  for (const char* range : {"-5000:6000", "-5000:", ":6000"}) {
    EXPECT_REFUSED(choose(range), HasSubstr("with samples beyond it, which lie between -"))
        << range;
  }
  EXPECT_REFUSED(choose("90:200", {{0, 0, 0}, {4, 4, 4}}), HasSubstr("samples within"));
  EXPECT_NO_THROW(choose("90:200"));
  EXPECT_NO_THROW(choose(":50"));
}

TEST(SurfaceWarnings, NameTheSkin) {
  const ChosenObject chosen = choose_object(ct(), {});
  EXPECT_THAT(surface_warnings(chosen, -450), testing::ElementsAre(HasSubstr("skin")));
  EXPECT_TRUE(surface_warnings(chosen, 350).empty());
  const ChosenObject asked = choose_object(ct(), {.tissue = parse_tissue("skin")});
  EXPECT_TRUE(surface_warnings(asked, -450).empty()) << "that is what was meant";
}

TEST(SurfaceWarnings, NameTheBorderOfTheFieldOfView) {
  Volume scan = ct();
  for_each_voxel(kCtGrid, [&](const std::array<Index, 3>& v, std::size_t n) {
    if (std::hypot(v[0] - 60, v[1] - 45) > 35) scan.samples[n] = -3024;  // cuts the patient
  });
  const ChosenObject chosen = choose_object(scan, {.tissue = parse_tissue("skin")});
  EXPECT_THAT(surface_warnings(chosen, -450), testing::ElementsAre(HasSubstr("field of view")));
  EXPECT_TRUE(surface_warnings(chosen, 350).empty()) << "the spine lies within";
  const ChosenObject dark = choose_object(scan, {.tissue = parse_tissue("dark"), .level = -450});
  EXPECT_THAT(surface_warnings(dark, -450), testing::ElementsAre(HasSubstr("field of view")));
  EXPECT_TRUE(surface_warnings(dark, 350).empty());
}

}  // namespace
}  // namespace mesamis
