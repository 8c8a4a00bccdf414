// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "mesamis/volume_files/formats.h"
#include "mesamis/volume_files/read_volume.h"
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
              HasSubstr("4-D one: 5 volumes"));
  EXPECT_THAT(spoilt("type: block\n" + grid + end), HasSubstr("block"));
  EXPECT_THAT(
      spoilt("type: short\ndimension: 3\nsizes: 3 4 5\nkinds: RGB-color domain domain\n" + end),
      HasSubstr("RGB-color"));
  EXPECT_THAT(spoilt("type: short\n" + grid + "encoding: bzip2\n"), HasSubstr("bzip2"));
  EXPECT_THAT(spoilt("type: short\n" + grid + "encoding: raw\n"), HasSubstr("\"endian\""));
  EXPECT_THAT(spoilt("type: short\n" + grid + end + "space: MNI\n"), HasSubstr("\"MNI\""));
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
    return open_nrrd(folder / "a.nrrd", {budget, false, Values::kMany});
  };
  const std::string directions = " (0.5,0,0) (0,1,0) (0,0,2)";
  for (const std::string& first :
       {"sizes: 4 3 5 1\nspace directions: none" + directions + "\n",
        std::string(
            "sizes: 4 3 5 1\nkinds: vector domain domain domain\nspacings: nan 0.5 1 2\n")}) {
    const ScanFile scan = open(first);
    EXPECT_EQ(scan.inner, 4);
    EXPECT_EQ(scan.outer, 1);
    EXPECT_THAT(scan.grid.size, testing::ElementsAre(3, 5, 1));
    expect_near(scan.grid.spacing, {0.5, 1, 2});
    EXPECT_EQ(scan.keys.at("key"), "value");
    EXPECT_THAT(read_samples(scan, budget), testing::ElementsAreArray(kRamp));
  }
  const ScanFile last = open(
      "sizes: 4 3 1 5\nkinds: domain domain domain list\n"
      "space directions:" +
      directions + " none\n");
  EXPECT_EQ(last.outer, 5);
  EXPECT_THAT(last.grid.size, testing::ElementsAre(4, 3, 1));
  EXPECT_THAT(complaint(folder / "a.nrrd"),
              HasSubstr("found a 4-D one: 5 volumes (--volume 0 to 4)"));
  EXPECT_REFUSED(open("sizes: 4 3 5 1\nkinds: domain list domain domain\n"), HasSubstr("\"list\""));
  EXPECT_REFUSED(open("sizes: 4 3 5 0\n"), HasSubstr("1 to 65535 values per voxel, found 0"));
}

/// A header of 4 x 3 x 5 voxels, and the rest of its fields.
VolumeFile with_fields(const TempFolder& folder, const std::string& fields,
                       const ReadOptions& options = {}) {
  write_bytes(folder / "a.nrrd",
              "NRRD0005\ntype: short\ndimension: 3\nsizes: 4 3 5\nencoding: raw\nendian: little\n" +
                  fields + "\n" + bytes_of_all(kRamp));
  return read_volume(folder / "a.nrrd", options);
}

const std::string kLps = "space: left-posterior-superior\n";
const std::string kDirections = "space directions: (20,0,0) (0,30,0) (0,0,40)\n";

TEST(Nrrd, HasLengthsInItsSpaceUnits) {
  const TempFolder folder;
  const auto origin = std::string("space origin: (1000,2000,3000)\n");
  const VolumeFile um = with_fields(
      folder, kLps + kDirections + origin + "space units: \"um\" \"micron\" \"\xc2\xb5m\"\n");
  expect_near(um.volume.spacing, {0.02, 0.03, 0.04});
  expect_near(um.volume.origin, {1, 2, 3});
  EXPECT_THAT(um.warnings, testing::IsEmpty());
  const VolumeFile mixed =
      with_fields(folder, kLps + kDirections + origin + "space units: \"cm\" mm \"in\"\n");
  expect_near(mixed.volume.spacing, {200, 30, 1016});
  const VolumeFile odd =
      with_fields(folder, kLps + kDirections + "space units: \"mm\" \"mm\" \"s\"\n");
  expect_near(odd.volume.spacing, {20, 30, 40});
  EXPECT_THAT(odd.warnings,
              testing::ElementsAre(HasSubstr("\"s\" of axis 2 is no unit of length")));
}

/// Spacings along the axes of the space have its units, unless the axes have their own.
TEST(Nrrd, SpacingsHaveTheUnitsOfTheSpace) {
  const TempFolder folder;
  const auto fields = kLps + "spacings: 20 30 40\nspace origin: (1000,2000,3000)\n",
             um = std::string("\"um\" \"um\" \"um\"\n"), cm = std::string("\"cm\" \"cm\" \"cm\"\n");
  const Volume alone = with_fields(folder, fields + "space units: " + um).volume;
  expect_near(alone.spacing, {0.02, 0.03, 0.04});
  expect_near(alone.origin, {1, 2, 3});
  const Volume axes = with_fields(folder, fields + "units: " + um).volume;
  expect_near(axes.spacing, {0.02, 0.03, 0.04});
  expect_near(axes.origin, {1, 2, 3});
  const Volume both = with_fields(folder, fields + "units: " + cm + "space units: " + um).volume;
  expect_near(both.spacing, {200, 300, 400});
  expect_near(both.origin, {1, 2, 3});
}

TEST(Nrrd, UnitsOfAxesCountWithoutSpaceDirections) {
  const TempFolder folder;
  const std::string units = "units: \"um\" \"um\" \"mm\"\n";
  expect_near(with_fields(folder, kLps + "spacings: 20 30 4\n" + units).volume.spacing,
              {0.02, 0.03, 4});
  const VolumeFile both = with_fields(folder, kLps + kDirections + units);
  expect_near(both.volume.spacing, {20, 30, 40});
  EXPECT_THAT(both.warnings, testing::ElementsAre(HasSubstr("do not count")));
}

/// As teem and ITK place them: an axis of cells begins at their outer side.
TEST(Nrrd, EndsOfAxesPlaceTheFirstVoxel) {
  const TempFolder folder;
  const std::string ends = "axis mins: 1 2 3\n";
  expect_near(with_fields(folder, kLps + "spacings: 2 2 4\n" + ends).volume.origin, {2, 3, 5});
  expect_near(with_fields(folder, kLps + "spacings: 2 2 4\ncenterings: node node cell\n" + ends)
                  .volume.origin,
              {1, 2, 5});
  const VolumeFile both =
      with_fields(folder,
                  "space: RAS\naxis mins: 0 0 0\naxis maxs: 8 4 5\ncenters: cell node cell\n"
                  "units: cm cm cm\n");
  expect_near(both.volume.spacing, {20, 20, 10});
  expect_near(both.volume.origin, {-10, 0, 5});
  EXPECT_THAT(both.warnings, testing::IsEmpty());
}

TEST(Nrrd, WarnsOfQuantisedValues) {
  const TempFolder folder;
  EXPECT_THAT(with_fields(folder, kLps + kDirections + "old min: -1024\nold max: 3071\n").warnings,
              testing::ElementsAre(HasSubstr("quantised")));
}

TEST(Nrrd, AGivenSpacingTakesThePlaceOfWhatCannotBeUsed) {
  const TempFolder folder;
  for (const std::string& fields :
       {kLps + "spacings: 0 1 1\n", kLps + "spacings: nan nan nan\n", kLps + "spacings: 1,2 1 1\n",
        kLps + "space directions: (0,0,0) (0,0,0) (0,0,0)\n", kLps + "spacings: 1 2\n",
        kLps + "space directions: none none none\n"}) {
    EXPECT_THROW(with_fields(folder, fields), InputError) << fields;
    const VolumeFile file = with_fields(folder, fields, {.spacing = Vec3{1, 1.2, 2}});
    EXPECT_EQ(file.volume.spacing, (Vec3{1, 1.2, 2})) << fields;
    expect_near(file.volume.direction * Vec3{0, 1, 0}, {0, 1, 0});
  }
}

TEST(Nrrd, ALeftHandedSpaceIsNotMirrored) {
  const TempFolder folder;
  const VolumeFile file = with_fields(folder, "space: 3D-left-handed\n" + kDirections);
  expect_near(file.volume.direction * Vec3{0, 0, 1}, {0, 0, -1});
  EXPECT_THAT(file.warnings, testing::ElementsAre(HasSubstr("no anatomical space")));
}

TEST(Nrrd, TakesOneOfSeveralValues) {
  const TempFolder folder;
  const auto first = [&](const std::string& sizes, Index number) {
    write_bytes(folder / "a.nrrd",
                "NRRD0005\ntype: short\ndimension: 4\nencoding: raw\nendian: little\n" + sizes +
                    "\n" + bytes_of_all(kRamp));
    return read_volume(folder / "a.nrrd", {.volume = number}).volume.samples[0];
  };
  EXPECT_EQ(first("sizes: 3 2 2 5\nkinds: domain domain domain time\n", 3), -40 + 36);
  EXPECT_EQ(first("sizes: 5 3 2 2\nkinds: vector domain domain domain\n", 3), -40 + 3);
}

TEST(Nrrd, ReadsListsOfDataFiles) {
  const TempFolder folder;
  const std::string data = bytes_of_all(kRamp), little = "endian: little\n";
  for (int k = 0; k < 5; ++k) {
    write_bytes(folder / ("s" + std::to_string(k + 8) + ".raw"), data.substr(24 * k, 24));
    write_bytes(folder / ("z0" + std::to_string(k) + ".gz"), packed(data.substr(24 * k, 24)));
  }
  expect_ramp(
      read(folder, "a.nhdr", nrrd_bytes(little + "encoding: raw\ndata file: s%d.raw 8 12 1\n", ""))
          .volume);
  expect_ramp(read(folder, "b.nhdr",
                   nrrd_bytes(little + "encoding: gzip\ndata file: z%02d.gz 0 4 1 2\n", ""))
                  .volume);
  expect_ramp(read(folder, "c.nhdr",
                   nrrd_bytes(little + "encoding: raw\ndata file: LIST\ns8.raw\ns9.raw\ns10.raw\n"
                                       "s11.raw\ns12.raw",
                              ""))
                  .volume);
  const auto refused = [&](const std::string& list) {
    return complaint(folder, "d.nhdr",
                     nrrd_bytes(little + "encoding: raw\ndata file: " + list, ""));
  };
  EXPECT_THAT(refused("LIST\ns8.raw\ns9.raw\n"), HasSubstr("equal numbers of slices"));
  EXPECT_THAT(refused("s%d.raw 8 13 1\n"), HasSubstr("equal numbers"));
  EXPECT_THAT(refused("s%d.raw 9 13 1\n"), HasSubstr("s13.raw"));
  EXPECT_THAT(refused("../s%d.raw 8 12 1\n"), HasSubstr("--allow-outside"));
}

/// As ITK writes images of four axes.
TEST(Nrrd, AFourthAxisMayHaveADirectionOfItsOwn) {
  const TempFolder folder;
  write_bytes(folder / "a.nrrd",
              "NRRD0004\ntype: short\ndimension: 4\nspace dimension: 4\nsizes: 4 3 1 5\n"
              "space directions: (0.5,0,0,0) (0,1.25,0,0) (0,0,2,0) (0,0,0,1)\n"
              "kinds: domain domain domain domain\nspace origin: (1,2,3,0)\nencoding: raw\n"
              "endian: little\n\n" +
                  bytes_of_all(kRamp));
  const Volume volume = read_volume(folder / "a.nrrd", {.volume = 2}).volume;
  expect_near(volume.spacing, {0.5, 1.25, 2});
  expect_near(volume.origin, {1, 2, 3});
  EXPECT_EQ(volume.samples[0], -40 + 24);
}

TEST(Nrrd, ASpaceMayHaveAnAxisOfTime) {
  const TempFolder folder;
  const auto place = [&](const std::string& space) {
    write_bytes(folder / "a.nrrd",
                "NRRD0004\ntype: short\ndimension: 4\nsizes: 4 3 1 5\nspace: " + space +
                    "\nspace directions: (0.5,0,0,0) (0,1.25,0,0) (0,0,2,0) (0,0,0,1)\n"
                    "space origin: (1,2,3,0)\nencoding: raw\nendian: little\n\n" +
                    bytes_of_all(kRamp));
    return read_volume(folder / "a.nrrd", {.volume = 2}).volume.origin;
  };
  for (const char* space : {"left-posterior-superior-time", "LPST"}) {
    expect_near(place(space), {1, 2, 3});
  }
  for (const char* space : {"Right-Anterior-Superior-Time", "RAST"}) {
    expect_near(place(space), {-1, -2, 3});
  }
  for (const char* space : {"left-anterior-superior-time", "LAST"}) {
    expect_near(place(space), {1, -2, 3});
  }
  EXPECT_REFUSED(place("upside-down-time"), HasSubstr("\"upside-down-time\""));
}

}  // namespace
}  // namespace mesamis
