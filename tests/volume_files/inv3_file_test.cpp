// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "mesamis/volume_files/read_volume.h"
#include "support/expect_near.h"
#include "support/read_scan.h"
#include "support/scan_bytes.h"
#include "support/temp_folder.h"
#include "support/test_data.h"

namespace mesamis {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

TEST(InVesalius, ReadsAPackedAndAPlainProject) {
  const TempFolder folder;
  const std::string tar = inv3_bytes(4, 3, 5, bytes_of_all(kRamp));
  for (const std::string& bytes : {tar, packed(tar)}) {
    const VolumeFile file = read(folder, "a.inv3", bytes);
    expect_ramp(file.volume);
    EXPECT_EQ(file.volume.modality, "CT");
    expect_near(file.volume.spacing, {0.5, 1.25, 2});
    expect_near(file.volume.direction * Vec3{0, 1, 0}, {0, -1, 0});
  }
  EXPECT_THAT(complaint(folder, "b.inv3", inv3_bytes(4, 3, 6, bytes_of_all(kRamp))),
              HasSubstr("expected 144 bytes, found 120"));
  EXPECT_THAT(complaint(folder, "c.inv3", inv3_bytes(4, 3, 5, bytes_of_all(kRamp), "object")),
              HasSubstr("object"));
  EXPECT_THAT(complaint(folder, "d.inv3", tar_entry("x/notes.txt", "hi")), HasSubstr("main.plist"));
}

/// The message about a project whose main.plist is this text.
std::string plist_complaint(const TempFolder& folder, const std::string& plist) {
  return complaint(folder, "p.inv3", tar_entry("x/main.plist", plist) + std::string(1024, '\0'));
}

TEST(InVesalius, HostilePropertyListsAreRefused) {
  const TempFolder folder;
  EXPECT_THAT(plist_complaint(folder,
                              "<!DOCTYPE plist [<!ENTITY x SYSTEM \"/etc/hostname\">]>"
                              "<plist><dict><key>&x;</key><string>&x;</string></dict></plist>"),
              HasSubstr("declarations of entities"));
  std::string nested = "<plist>";
  for (int n = 0; n < 1000; ++n) nested += "<dict><key>" + std::string(500, 'A') + "</key>";
  EXPECT_THAT(plist_complaint(folder, nested), HasSubstr("at most 32 elements within"));
  EXPECT_THAT(plist_complaint(folder, "<plist><dict></dict></plist>"),
              HasSubstr("expected 3 values for \"matrix/shape\", found 0"));
}

TEST(InVesalius, ReadsTheDistributionsCranium) {
  const fs::path cranium = "/usr/share/doc/invesalius-examples/examples/Cranium.inv3";
  MESAMIS_REQUIRE_DATA(cranium);
  const VolumeFile file = read_volume(cranium);
  EXPECT_EQ(file.volume.size, (std::array<Index, 3>{256, 256, 108}));
  expect_near(file.volume.spacing, {0.9570312, 0.9570312, 1.5});
  const fs::path same = test_data("data/cranium_inv/ct.nrrd");
  MESAMIS_REQUIRE_DATA(same);
  const Volume other = read_volume(same).volume;
  EXPECT_EQ(file.volume.samples, other.samples);
  EXPECT_EQ(file.volume.direction, other.direction);
}

TEST(Inv3, AGivenSpacingTakesThePlaceOfWhatCannotBeUsed) {
  const TempFolder folder;
  std::string bytes = inv3_bytes(4, 3, 5, bytes_of_all(kRamp));
  bytes.replace(bytes.find("<real>0.5</real>"), 16, "<real>0.0</real>");
  EXPECT_NE(complaint(folder, "a.inv3", bytes), "");
  const VolumeFile file = read_volume(folder / "a.inv3", {.spacing = Vec3{1, 1.2, 2}});
  EXPECT_EQ(file.volume.spacing, (Vec3{1, 1.2, 2}));
  EXPECT_EQ(file.volume.direction * (Vec3{0, 1, 0}), (Vec3{0, -1, 0}));
}

}  // namespace
}  // namespace mesamis
