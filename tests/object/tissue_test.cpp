// SPDX-License-Identifier: Apache-2.0
#include "mesamis/object/tissue.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "object/object_scenes.h"
#include "support/throws.h"

namespace mesamis {
namespace {

using testing::HasSubstr;

TEST(Tissues, OfTheTableAreReadByTheirNames) {
  std::set<std::string> names;
  for (const Tissue& tissue : tissue_table()) {
    EXPECT_EQ(parse_tissue(tissue.name).name, tissue.name);
    EXPECT_EQ(parse_tissue(tissue.name).levels.high, tissue.levels.high);
    names.insert(tissue.name);
  }
  EXPECT_EQ(names, (std::set<std::string>{"airway", "bone", "dark", "lung", "skin", "soft", "teeth",
                                          "vessel"}));
}

TEST(Tissues, OfTheTableSearchWithinTheirLevels) {
  for (const Tissue& tissue : tissue_table()) {
    EXPECT_LT(tissue.values.low, tissue.values.high) << tissue.name;
    EXPECT_LT(tissue.levels.low, tissue.levels.high) << tissue.name;
    EXPECT_FALSE(tissue.level_is_given()) << tissue.name;
    EXPECT_FALSE(tissue.help.empty()) << tissue.name;
    EXPECT_EQ(tissue.start.has_value(), tissue.hounsfield) << tissue.name;
    if (!tissue.start) continue;
    EXPECT_GT(*tissue.start, tissue.levels.low) << tissue.name;
    EXPECT_LT(*tissue.start, tissue.levels.high) << tissue.name;
  }
}

TEST(Tissues, AreRangesOfValues) {
  const Tissue both = parse_tissue("300:1200.5");
  EXPECT_EQ(both.kind, TissueKind::kRange);
  EXPECT_EQ(both.values.low, 300);
  EXPECT_EQ(both.values.high, 1200.5);
  EXPECT_EQ(both.name, "300:1200.5");
  EXPECT_FALSE(both.hounsfield);
  const Tissue bright = parse_tissue("+300:");
  EXPECT_EQ(bright.kind, TissueKind::kBright);
  EXPECT_EQ(bright.levels.low, 300);
  EXPECT_TRUE(std::isinf(bright.values.high));
  const Tissue dark = parse_tissue(":-500");
  EXPECT_EQ(dark.kind, TissueKind::kDark);
  EXPECT_EQ(dark.levels.high, -500);
  EXPECT_TRUE(bright.level_is_given() && dark.level_is_given());
  EXPECT_TRUE(std::isinf(dark.values.low));
}

TEST(Tissues, ThatAreNeitherAreRefused) {
  for (const auto* text :
       {"", "bones", "Bone", ":", "a:b", "1:2:3", "2:1", "1:1", "nan:2", "1:inf", "1 :2", "300"}) {
    EXPECT_REFUSED(parse_tissue(text), HasSubstr("expected bone, teeth, soft, skin, lung, airway, "
                                                 "vessel, dark, or LO:HI"));
  }
  EXPECT_REFUSED(parse_tissue("x\ny"), HasSubstr("\"x y\""));
}

Volume ct(double bone_share) {
  Volume volume;
  volume.size = {100, 100, 1};
  volume.modality = "CT";
  volume.samples.assign(10'000, 40);
  for (std::size_t n = 0; n < 5000; ++n) volume.samples[n] = -1000;
  for (std::size_t n = 0; n < std::size_t(10'000 * bone_share); ++n) volume.samples[9999 - n] = 900;
  return volume;
}

TEST(SuggestedTissue, IsBoneWhereThereIsBone) {
  EXPECT_EQ(suggested_tissue(ct(0.01))->name, "bone");
  EXPECT_EQ(suggested_tissue(ct(0))->name, "skin");
}

TEST(SuggestedTissue, IsNothingBesideCt) {
  Volume volume = ct(0.01);
  volume.modality = "MR";
  EXPECT_FALSE(suggested_tissue(volume));
}

TEST(SurfaceAtLevel, NamesWhatALevelShows) {
  const Volume volume = ct(0.01);
  EXPECT_EQ(surface_at_level(volume, -400), "skin");
  EXPECT_EQ(surface_at_level(volume, 20), "soft tissue");
  EXPECT_EQ(surface_at_level(volume, 100), "vessels or spongy bone");
  EXPECT_EQ(surface_at_level(volume, 300), "bone");
}

TEST(SurfaceAtLevel, IsEmptyWhereNothingIsKnown) {
  Volume volume = ct(0.01);
  EXPECT_EQ(surface_at_level(volume, 900), "");
  EXPECT_EQ(surface_at_level(volume, -1001), "");
  volume.samples[0] = 3000;
  EXPECT_EQ(surface_at_level(volume, 2500), "metal");
  volume.modality = "MR";
  EXPECT_EQ(surface_at_level(volume, 300), "");
}

}  // namespace
}  // namespace mesamis
