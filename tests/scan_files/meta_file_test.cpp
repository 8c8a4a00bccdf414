// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "mesamis/scan_files/read_volume.h"
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
  EXPECT_THAT(complaint(folder, "c.mha", "NDims = 4\nElementDataFile = LOCAL\n"),
              HasSubstr("4 dim"));
  EXPECT_THAT(
      complaint(folder, "d.mha", meta_bytes("TransformMatrix = 2 0 0 0 2 0 0 0 2\n") + data),
      HasSubstr("length 2"));
}

}  // namespace
}  // namespace mesamis
