// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "mesamis/io/read_volume.h"
#include "mesamis/io/write_volume.h"
#include "support/expect_near.h"
#include "support/read_scan.h"
#include "support/scan_bytes.h"
#include "support/temp_folder.h"
#include "support/throws.h"

namespace mesamis {
namespace {

using testing::HasSubstr;

TEST(Nrrd, ReadsItsEncodingsAndSkips) {
  const TempFolder folder;
  const std::string data = bytes_of_all(kRamp), little = "endian: little\n";
  std::string text;
  for (const int value : kRamp) text += std::to_string(value) + (value % 4 ? " " : "\n");
  expect_ramp(read(folder, "a.nrrd", nrrd_bytes("encoding: raw\n" + little, data)).volume);
  expect_ramp(read(folder, "b.nrrd", nrrd_bytes("encoding: gzip\n" + little, packed(data))).volume);
  expect_ramp(read(folder, "c.nrrd", nrrd_bytes("encoding: ascii\n", text)).volume);
  expect_ramp(
      read(folder, "d.nrrd", nrrd_bytes("encoding: raw\nendian: big\n", bytes_of_all(kRamp, true)))
          .volume);
  expect_ramp(
      read(folder, "e.nrrd",
           nrrd_bytes("encoding: raw\nline skip: 1\nbyte skip: 3\n" + little, "one\nabc" + data))
          .volume);
  expect_ramp(read(folder, "f.nrrd",
                   nrrd_bytes("encoding: raw\nbyte skip: -1\n" + little, "anything" + data))
                  .volume);
  expect_ramp(read(folder, "g.nrrd",
                   nrrd_bytes("encoding: gzip\nbyte skip: 4\n" + little, packed("four" + data)))
                  .volume);
  write_bytes(folder / "data.raw", data);
  expect_ramp(
      read(folder, "h.nhdr", nrrd_bytes("encoding: raw\ndata file: data.raw\n" + little, ""))
          .volume);
  EXPECT_THAT(complaint(folder, "i.nhdr",
                        nrrd_bytes("encoding: raw\ndata file: missing.raw\n" + little, "")),
              HasSubstr("missing.raw"));
  write_bytes(folder / "long.raw", data + "x");
  EXPECT_THAT(
      complaint(folder, "j.nhdr", nrrd_bytes("encoding: raw\ndata file: long.raw\n" + little, "")),
      HasSubstr("go on"));
}

TEST(Nrrd, PutsItsSpacesIntoLps) {
  const TempFolder folder;
  const auto origin = [&](const std::string& space) {
    return read(
               folder, "a.nrrd",
               "NRRD0005\ntype: int16\ndimension: 3\nsizes: 4 3 5\nspace: " + space +
                   "\nspace directions: (0.5, 0, 0) (0,1.25,0) (0,0,2)\nspace origin: (1,2,3)\n"
                   "kinds: domain domain domain\nendian: little\nencoding: raw\nkey:=a: value\n\n" +
                   bytes_of_all(kRamp))
        .volume;
  };
  expect_near(origin("left-posterior-superior").origin, {1, 2, 3});
  expect_near(origin("RAS").origin, {-1, -2, 3});
  expect_near(origin("left-anterior-superior").origin, {1, -2, 3});
  expect_near(origin("RAS").direction * Vec3{1, 0, 0}, {-1, 0, 0});
  expect_near(origin("LAS").direction * Vec3{0, 1, 0}, {0, -1, 0});
}

TEST(Nrrd, RefusesWhatItCannotMean) {
  const TempFolder folder;
  const auto spoilt = [&](const std::string& fields) {
    return complaint(folder, "a.nrrd", "NRRD0004\n" + fields + "\n" + bytes_of_all(kRamp));
  };
  const std::string end = "encoding: raw\nendian: little\n", grid = "dimension: 3\nsizes: 4 3 5\n";
  EXPECT_THAT(spoilt("type: short\ndimension: 4\nsizes: 2 2 3 5\n" + end),
              HasSubstr("4 dimensions"));
  EXPECT_THAT(spoilt("type: block\n" + grid + end), HasSubstr("block"));
  EXPECT_THAT(
      spoilt("type: short\ndimension: 3\nsizes: 3 4 5\nkinds: RGB-color domain domain\n" + end),
      HasSubstr("RGB-color"));
  EXPECT_THAT(spoilt("type: short\n" + grid + "encoding: bzip2\n"), HasSubstr("bzip2"));
  EXPECT_THAT(spoilt("type: short\n" + grid + "encoding: raw\n"), HasSubstr("\"endian\""));
  EXPECT_THAT(spoilt("type: short\n" + grid + end + "space: MNI\n"), HasSubstr("mni"));
  EXPECT_THAT(spoilt("type: short\n" + grid + end + "data file: LIST\n"), HasSubstr("list"));
  EXPECT_THAT(spoilt("type: short\n" + grid + end + "byte skip: -5\n"), HasSubstr("-5"));
  EXPECT_THAT(spoilt("type: short\n" + grid + end + "spacings: 1 2\n"), HasSubstr("found 2"));
  EXPECT_THAT(spoilt("type: short\n" + grid + end + "spacings: 1 2 0\n"), HasSubstr("found 0 mm"));
  EXPECT_THAT(spoilt("type: short\n" + grid + end + "space directions: (1,0,0) (0,1,0) none\n"),
              HasSubstr("none"));
  EXPECT_THAT(spoilt("type: short\n" + grid + end + "space directions: (1,0,0) (1,1,0) (0,0,1)\n"),
              HasSubstr("orthogonal"));
  EXPECT_THAT(spoilt("nonsense\n"), HasSubstr("nonsense"));
}

/// Turned, shifted, left-handed, with numbers that have no short decimals.
Volume odd_volume() {
  Volume volume;
  volume.size = {4, 3, 2};
  volume.spacing = {0.1, 1.0 / 3, 2.5};
  volume.origin = {-10.7, 1e-3, 1234.5678901234567};
  volume.direction = {{Vec3{0.6, 0.8, 0}, Vec3{0.8, -0.6, 0}, Vec3{0, 0, 1}}};
  for (int n = 0; n < 24; ++n) volume.samples.push_back(static_cast<float>(1000.0 / 7 * n - 900));
  return volume;
}

TEST(Nrrd, ReadsWhatItWrote) {
  const TempFolder folder;
  const Volume volume = odd_volume();
  for (const bool gzip : {false, true}) {
    write_nrrd(folder / "a.nrrd", volume, {.gzip = gzip});
    const VolumeFile file = read_volume(folder / "a.nrrd");
    EXPECT_EQ(file.format, "NRRD");
    EXPECT_THAT(file.warnings, testing::IsEmpty());
    EXPECT_EQ(file.volume.size, volume.size);
    EXPECT_EQ(file.volume.samples, volume.samples);
    EXPECT_EQ(file.volume.origin, volume.origin);
    expect_near(file.volume.spacing, volume.spacing, 1e-15);
    for (std::size_t a = 0; a < 3; ++a) {
      expect_near(file.volume.direction.rows[a], volume.direction.rows[a], 1e-15);
    }
  }
}

TEST(Nrrd, WritesShortsRounded) {
  const TempFolder folder;
  Volume volume = odd_volume();
  const NrrdOptions options{.type = SampleType::kShort, .gzip = true};
  write_nrrd(folder / "a.nrrd", volume, options);
  const Volume found = read_volume(folder / "a.nrrd").volume;
  for (std::size_t n = 0; n < volume.samples.size(); ++n) {
    EXPECT_EQ(found.samples[n], std::round(volume.samples[n]));
  }
  for (const float bad : {32768.F, -32769.F, std::numeric_limits<float>::quiet_NaN()}) {
    volume.samples[5] = bad;
    EXPECT_REFUSED(write_nrrd(folder / "b.nrrd", volume, options), HasSubstr("16 bits"));
  }
  EXPECT_EQ(folder.file_count(), 1);
}

TEST(Nrrd, RefusesToWriteWhatNobodyCouldRead) {
  const TempFolder folder;
  Volume volume = odd_volume();
  EXPECT_REFUSED(write_nrrd(folder / "a.nii", volume), HasSubstr(".nrrd"));
  EXPECT_REFUSED(write_nrrd(folder / "no" / "a.nrrd", volume), HasSubstr("cannot be written"));
  volume.samples.pop_back();
  EXPECT_REFUSED(write_nrrd(folder / "a.nrrd", volume), HasSubstr("expected 24 samples, found 23"));
  EXPECT_EQ(folder.file_count(), 0);
}

}  // namespace
}  // namespace mesamis
