// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "mesamis/volume_files/read_volume.h"
#include "support/expect_near.h"
#include "support/read_scan.h"
#include "support/scan_bytes.h"
#include "support/temp_folder.h"

namespace mesamis {
namespace {

using testing::HasSubstr;

TEST(Meta, ReadsLocalPackedTextAndDetachedData) {
  const TempFolder folder;
  const std::string data = bytes_of_all(kRamp);
  std::string text;
  for (const int value : kRamp) text += std::to_string(value) + " ";
  const VolumeFile file = read(folder, "a.mha", meta_bytes("BinaryData = True\n") + data);
  expect_ramp(file.volume);
  EXPECT_EQ(file.volume.modality, "CT");
  expect_near(file.volume.origin, {1, 2, 3});
  expect_near(file.volume.spacing, {0.5, 1.25, 2});
  expect_ramp(read(folder, "b.mha",
                   meta_bytes("BinaryDataByteOrderMSB = True\n") + bytes_of_all(kRamp, true))
                  .volume);
  expect_ramp(
      read(folder, "c.mha", meta_bytes("CompressedData = True\n") + packed(data, 15)).volume);
  expect_ramp(read(folder, "d.mha", meta_bytes("BinaryData = False\n") + text).volume);
  write_bytes(folder / "my data.raw", "head" + data);
  expect_ramp(read(folder, "e.mhd", meta_bytes("HeaderSize = 4\n", "my data.raw")).volume);
  expect_ramp(read(folder, "f.mhd", meta_bytes("HeaderSize = -1\n", "my data.raw")).volume);
  EXPECT_THAT(complaint(folder, "g.mhd", meta_bytes("", "my data.raw")), HasSubstr("go on"));
  EXPECT_THAT(complaint(folder, "h.mhd", meta_bytes("", "slice%03d.raw 1 5 1")),
              HasSubstr("slice"));
}

TEST(Meta, WarnsOfSlicesBehindThoseOfItsHeader) {
  const TempFolder folder;
  const std::string bytes = meta_bytes("BinaryData = True\n") + bytes_of_all(kRamp);
  EXPECT_TRUE(read(folder, "a.mha", bytes + std::string(23, 'x')).warnings.empty());
  EXPECT_THAT(read(folder, "a.mha", bytes + std::string(24, 'x')).warnings,
              testing::ElementsAre(HasSubstr("goes on for 24 bytes")));
}

TEST(Meta, ListsTheAxesOneAfterAnother) {
  const TempFolder folder;
  const Volume volume =
      read(folder, "a.mha",
           meta_bytes("TransformMatrix = 0 1 0 -1 0 0 0 0 1\n") + bytes_of_all(kRamp))
          .volume;
  expect_near(volume.direction * Vec3{1, 0, 0}, {0, 1, 0});
  expect_near(volume.direction * Vec3{0, 1, 0}, {-1, 0, 0});
}

TEST(Meta, RefusesChannelsOtherDimensionsAndLengths) {
  const TempFolder folder;
  const std::string data = bytes_of_all(kRamp);
  EXPECT_THAT(complaint(folder, "a.mha", meta_bytes("ElementNumberOfChannels = 3\n") + data),
              HasSubstr("3 channels"));
  EXPECT_THAT(complaint(folder, "b.mha", "NDims = 4\n" + data), HasSubstr("expected"));
  EXPECT_THAT(complaint(folder, "c.mha", "NDims = 5\nElementDataFile = LOCAL\n"),
              HasSubstr("5 dim"));
  EXPECT_THAT(
      complaint(folder, "d.mha", meta_bytes("TransformMatrix = 2 0 0 0 2 0 0 0 2\n") + data),
      HasSubstr("length 2"));
}

TEST(Meta, HasLengthsInItsUnits) {
  const TempFolder folder;
  const auto with = [&](const std::string& fields) {
    return read(folder, "a.mha", meta_bytes(fields) + bytes_of_all(kRamp));
  };
  expect_near(with("DistanceUnits = um\n").volume.spacing, {5e-4, 1.25e-3, 2e-3});
  expect_near(with("DistanceUnits = cm\n").volume.origin, {10, 20, 30});
  EXPECT_THAT(with("DistanceUnits = ?\n").warnings, testing::IsEmpty());
  EXPECT_THAT(with("DistanceUnits = ells\n").warnings,
              testing::ElementsAre(HasSubstr("DistanceUnits \"ells\"")));
}

TEST(Meta, HasValuesOnALine) {
  const TempFolder folder;
  const auto with = [&](const std::string& slope, const std::string& offset) {
    return read(folder, "a.mha",
                meta_bytes("ElementToIntensityFunctionSlope = " + slope +
                           "\nElementToIntensityFunctionOffset = " + offset + "\n") +
                    bytes_of_all(kRamp));
  };
  expect_ramp(with("2", "-5").volume, 5, 2, -5);
  const VolumeFile flat = with("0", "1");
  expect_ramp(flat.volume);
  EXPECT_THAT(flat.warnings, testing::ElementsAre(HasSubstr("kept as stored")));
}

/// Letters of the sides that the axes come from; other readers do not turn the axes by them.
TEST(Meta, WarnsWhereItsLettersContradictItsMatrix) {
  const TempFolder folder;
  const auto warnings = [&](const std::string& letters, const std::string& matrix) {
    return read(folder, "a.mha",
                meta_bytes("AnatomicalOrientation = " + letters + "\nTransformMatrix = " + matrix +
                           "\n") +
                    bytes_of_all(kRamp))
        .warnings;
  };
  const std::string same = "1 0 0 0 1 0 0 0 1", turned = "-1 0 0 0 -1 0 0 0 1";
  EXPECT_THAT(warnings("RAI", same), testing::IsEmpty());
  EXPECT_THAT(warnings("LPI", turned), testing::IsEmpty());
  EXPECT_THAT(warnings("???", turned), testing::IsEmpty());
  EXPECT_THAT(warnings("RSA", same), testing::ElementsAre(HasSubstr("RSA")));
}

TEST(Meta, TakesOneOfSeveralVolumesAndChannels) {
  const TempFolder folder;
  write_bytes(folder / "a.mha",
              "NDims = 4\nDimSize = 2 2 1 5\nElementType = MET_SHORT\n"
              "ElementNumberOfChannels = 3\nElementSpacing = 0.5 1.25 2 1\nOffset = 1 2 3 0\n"
              "TransformMatrix = 0 1 0 0 -1 0 0 0 0 0 1 0 0 0 0 1\nElementDataFile = LOCAL\n" +
                  bytes_of_all(kRamp));
  const Volume volume = read_volume(folder / "a.mha", {.volume = 4, .channel = 2}).volume;
  EXPECT_THAT(volume.samples, testing::ElementsAre(-40 + 50, -40 + 53, -40 + 56, -40 + 59));
  expect_near(volume.spacing, {0.5, 1.25, 2});
  expect_near(volume.origin, {1, 2, 3});
  expect_near(volume.direction * Vec3{1, 0, 0}, {0, 1, 0});
  EXPECT_THAT(complaint(folder / "a.mha"), HasSubstr("5 volumes (--volume 0 to 4) of 3 channels"));
}

TEST(Meta, AGivenSpacingTakesThePlaceOfWhatCannotBeUsed) {
  const TempFolder folder;
  for (const char* spacing : {"0 0 0", "-1 1 1", "nan 1 1", "1,2 1 1", "1 2"}) {
    const std::string bytes =
        "NDims = 3\nDimSize = 4 3 5\nElementType = MET_SHORT\nElementSpacing = " +
        std::string(spacing) + "\nElementDataFile = LOCAL\n" + bytes_of_all(kRamp);
    EXPECT_NE(complaint(folder, "a.mha", bytes), "") << spacing;
    const VolumeFile file = read_volume(folder / "a.mha", {.spacing = Vec3{1, 1.2, 2}});
    EXPECT_EQ(file.volume.spacing, (Vec3{1, 1.2, 2})) << spacing;
  }
}

TEST(Meta, ReadsListsOfDataFiles) {
  const TempFolder folder;
  const std::string data = bytes_of_all(kRamp);
  std::string list = "LIST\n";
  for (int k = 0; k < 5; ++k) {
    const std::string name = "s0" + std::to_string(k + 1) + ".raw";
    write_bytes(folder / name, data.substr(24 * static_cast<std::size_t>(k), 24));
    list += name + "\n";
  }
  expect_ramp(read(folder, "a.mhd", meta_bytes("", "s%02d.raw 1 5 1")).volume);
  expect_ramp(read(folder, "b.mhd", meta_bytes("", list)).volume);
  EXPECT_THAT(complaint(folder, "c.mhd", meta_bytes("", "LIST")), HasSubstr("an empty one"));
  EXPECT_THAT(complaint(folder, "d.mhd", meta_bytes("", "s%02x.raw 1 5 1")), HasSubstr("pattern"));
}

}  // namespace
}  // namespace mesamis
