// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "mesamis/scan_files/formats.h"
#include "mesamis/scan_files/read_volume.h"
#include "support/expect_near.h"
#include "support/read_scan.h"
#include "support/scan_bytes.h"
#include "support/temp_folder.h"
#include "support/throws.h"
#include "support/wide_budget.h"

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

TEST(Nrrd, HasManyValuesPerVoxelForThoseWhoAsk) {
  const TempFolder folder;
  WideBudget budget;
  const auto open = [&](const std::string& fields) {
    write_bytes(folder / "a.nrrd",
                "NRRD0004\ntype: short\nencoding: raw\nendian: little\n"
                "dimension: 4\nkey:=value\n" +
                    fields + "\n" + bytes_of_all(kRamp));
    return detail::open_nrrd(folder / "a.nrrd", {budget, false, detail::Values::kMany});
  };
  const std::string directions = " (0.5,0,0) (0,1,0) (0,0,2)";
  for (const std::string& first :
       {"sizes: 4 3 5 1\nspace directions: none" + directions + "\n",
        std::string(
            "sizes: 4 3 5 1\nkinds: vector domain domain domain\nspacings: nan 0.5 1 2\n")}) {
    const detail::ScanFile scan = open(first);
    EXPECT_EQ(scan.inner, 4);
    EXPECT_EQ(scan.outer, 1);
    EXPECT_THAT(scan.grid.size, testing::ElementsAre(3, 5, 1));
    expect_near(scan.grid.spacing, {0.5, 1, 2});
    EXPECT_EQ(scan.keys.at("key"), "value");
    EXPECT_THAT(detail::read_samples(scan, budget), testing::ElementsAreArray(kRamp));
  }
  const detail::ScanFile last = open(
      "sizes: 4 3 1 5\nkinds: domain domain domain list\n"
      "space directions:" +
      directions + " none\n");
  EXPECT_EQ(last.outer, 5);
  EXPECT_THAT(last.grid.size, testing::ElementsAre(4, 3, 1));
  EXPECT_THAT(complaint(folder / "a.nrrd"), HasSubstr("found 4 dimensions"));
  EXPECT_REFUSED(open("sizes: 4 3 5 1\nkinds: domain list domain domain\n"), HasSubstr("\"list\""));
  EXPECT_REFUSED(open("sizes: 4 3 5 0\n"), HasSubstr("1 to 65535 values per voxel, found 0"));
}

}  // namespace
}  // namespace mesamis
