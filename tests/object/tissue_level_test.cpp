// SPDX-License-Identifier: Apache-2.0
#include "mesamis/object/tissue_level.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "mesamis/base/parallel.h"
#include "mesamis/method/prepare.h"
#include "mesamis/object/mirror.h"
#include "object/object_scenes.h"
#include "support/ball_volume.h"
#include "support/throws.h"

namespace mesamis {
namespace {

using testing::HasSubstr;

/// A ball of bone in soft tissue.
Volume bone_ball(double bone) {
  Volume volume = make_ball({.background = 40, .object = bone, .noise = 10});
  volume.modality = "CT";
  return volume;
}

TEST(TissueLevel, OfBoneIsMidwayToWhatSurroundsIt) {
  const TissueLevel bone = find_tissue_level(bone_ball(1000), parse_tissue("bone"));
  EXPECT_TRUE(bone.measured);
  EXPECT_FALSE(bone.bounded);
  EXPECT_NEAR(bone.level, 520, 10);
  EXPECT_NEAR(bone.contrast.background, 40, 20);
  EXPECT_NEAR(bone.contrast.object, 1000, 20);
}

TEST(TissueLevel, OfBoneIsThatOfARunWithoutATissue) {
  for (const double value : {500.0, 1000.0, 1400.0}) {
    const Volume volume = bone_ball(value);
    EXPECT_NEAR(find_tissue_level(volume, parse_tissue("bone")).level,
                prepare_image(volume, Settings{}).parameters.level, 1e-6);
  }
}

TEST(TissueLevel, DoesNotLeaveTheTissuesLevels) {
  const TissueLevel bone = find_tissue_level(bone_ball(2900), parse_tissue("bone"));
  EXPECT_EQ(bone.level, 1000);
  EXPECT_TRUE(bone.bounded);
  EXPECT_FALSE(bone.measured);
}

/// The search starts at the tissue: of two edges in a scan each preset finds its own.
TEST(TissueLevel, OfSkinAndOfBoneDifferInOneScan) {
  Volume volume = make_ball(
      {.size = 56, .background = 40, .object = 1000, .noise = 10, .radius = 12, .air = -1000});
  volume.modality = "CT";
  EXPECT_NEAR(find_tissue_level(volume, parse_tissue("bone")).level, 520, 15);
  EXPECT_NEAR(find_tissue_level(volume, parse_tissue("skin")).level, -480, 15);
}

TEST(TissueLevel, OfADarkObjectIsThatOfTheMirroredBrightOne) {
  const Volume bright = make_ball({.background = 100, .object = 300, .noise = 3});
  const Tissue dark = ImageUnits(TissueKind::kDark).turned(parse_tissue("dark"));
  const TissueLevel found = find_tissue_level(bright, dark);
  EXPECT_NEAR(found.level, 200, 4);
  EXPECT_NEAR(found.contrast.object, 300, 8);
  EXPECT_NEAR(found.level, prepare_image(bright, Settings{}).parameters.level, 1e-6);
}

TEST(TissueLevel, OfARangeIsAsWritten) {
  const Volume volume = bone_ball(1000);
  for (const auto& [text, level] :
       {std::pair{"300:", 300.0}, {":-500", -500.0}, {"100:300", 100.0}}) {
    const TissueLevel found = find_tissue_level(volume, parse_tissue(text));
    EXPECT_EQ(found.level, level);
    EXPECT_FALSE(found.measured);
    EXPECT_EQ(found.uncertainty, 0);
  }
}

TEST(TissueLevel, WithoutItsSurfaceIsTheStart) {
  Volume volume = bone_ball(40);  // nothing but noise about 40 HU
  const TissueLevel teeth = find_tissue_level(volume, parse_tissue("teeth"));
  EXPECT_EQ(teeth.level, 1300);
  EXPECT_FALSE(teeth.measured);
}

TEST(TissueLevel, RefusesWhatCannotBeMeasured) {
  Volume volume = bone_ball(1000);
  volume.modality = "MR";
  EXPECT_REFUSED(require_hounsfield(volume, parse_tissue("bone")), HasSubstr("CT scan"));
  EXPECT_NO_THROW(require_hounsfield(volume, parse_tissue("300:")));
  const Volume noise = make_ball({.background = 100, .object = 100, .noise = 10});
  EXPECT_REFUSED(find_tissue_level(noise, parse_tissue("dark")), HasSubstr("from the noise"));
}

TEST(TissueLevel, HasTheSameBitsForAnyNumberOfThreads) {
  const Volume volume = bone_ball(1000);
  const auto level = [&] { return find_tissue_level(volume, parse_tissue("bone")).level; };
  EXPECT_EQ(with_threads(2, level), with_threads(1, level));
}

}  // namespace
}  // namespace mesamis
