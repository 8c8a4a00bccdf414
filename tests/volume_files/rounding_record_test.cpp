// SPDX-License-Identifier: Apache-2.0
#include "mesamis/volume_files/rounding_record.h"

#include <gmock/gmock.h>

#include <cmath>
#include <functional>

#include "mesamis/volume_files/read_volume.h"
#include "support/scan_bytes.h"
#include "support/temp_folder.h"
#include "support/throws.h"

namespace mesamis {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr int kRounded = 6 * 5 * 4;

template <class Number>
std::string bytes_of_numbers(const std::function<Number(int)>& number) {
  std::string bytes;
  for (int n = 0; n < kRounded; ++n) {
    const Number value = number(n);
    bytes.append(reinterpret_cast<const char*>(&value), sizeof(value));
  }
  return bytes;
}

/// A NRRD file of 6 x 5 x 4 voxels as it is read.
VolumeFile read_nrrd_of(const std::string& type, const std::string& bytes,
                        const std::string& encoding = "raw") {
  const TempFolder folder;
  write_bytes(folder / "a.nrrd",
              "NRRD0004\ntype: " + type + "\ndimension: 3\nsizes: 6 5 4\nspacings: 1 1 1\n" +
                  "space: left-posterior-superior\nspace directions: (1,0,0) (0,1,0) (0,0,1)\n" +
                  "endian: little\nencoding: " + encoding + "\n\n" + bytes);
  return read_volume(folder / "a.nrrd");
}

template <class Number>
std::vector<std::string> warnings_of(const std::string& type,
                                     const std::function<Number(int)>& number) {
  return read_nrrd_of(type, bytes_of_numbers<Number>(number)).warnings;
}

/// Nobody looks at samples that cannot be rounded.
TEST(RoundingRecord, WholeNumbersThatSinglePrecisionHoldsAreExact) {
  int exact = 0;
  for (const double slope : {1.0, -1.0, 2.0, 0.5, 16.0, 255.0, 256.0, 1000.0}) {
    for (const double intercept : {0.0, -1024.0, 0.25, 65536.0, 16711680.0, 1e9}) {
      if (may_be_rounded<std::int16_t>(slope, intercept)) continue;
      ++exact;
      for (int stored = -32768; stored <= 65535; ++stored) {
        const double value = slope * stored + intercept;
        ASSERT_EQ(static_cast<double>(static_cast<float>(value)), value);
      }
    }
  }
  EXPECT_GT(exact, 10);
  EXPECT_FALSE(may_be_rounded<float>(1, 0));
  EXPECT_TRUE(may_be_rounded<float>(2, 0));
  EXPECT_TRUE(may_be_rounded<double>(1, 0));
  EXPECT_TRUE(may_be_rounded<std::uint16_t>(1, 1e9));
}

/// Whole numbers and those in double precision far from 0 lose their steps.
TEST(RoundingRecord, StepsThatSinglePrecisionLosesAreTold) {
  const auto told = ElementsAre(AllOf(HasSubstr("to steps of 64"), HasSubstr("subtract")));
  EXPECT_THAT(warnings_of<std::uint32_t>("uint32", [](int n) { return 1000000000u + n; }), told);
  EXPECT_THAT(warnings_of<std::int32_t>("int32", [](int n) { return -1000000000 - n; }),
              ElementsAre(HasSubstr("from -1000000119 to -1000000000")));
  EXPECT_THAT(
      warnings_of<std::uint64_t>("uint64", [](int n) { return (1ull << 60) + (1ull << 34) * n; }),
      ElementsAre(HasSubstr("to steps of")));
  EXPECT_THAT(warnings_of<double>("double", [](int n) { return 1e9 + n; }), told);
  std::string text;
  for (int n = 0; n < kRounded; ++n) text += std::to_string(1000000000 + n) + " ";
  EXPECT_THAT(read_nrrd_of("double", text, "ascii").warnings, told);
}

/// Voxels that were not measured make no greater range of it.
TEST(RoundingRecord, ZerosDoNotHideThem) {
  EXPECT_THAT(
      warnings_of<std::uint32_t>("uint32", [](int n) { return n % 7 == 0 ? 0 : 1000000000u + n; }),
      ElementsAre(HasSubstr("steps of 64")));
}

TEST(RoundingRecord, WhatMattersToNobodyIsNotTold) {
  EXPECT_THAT(warnings_of<std::uint32_t>("uint32", [](int n) { return n; }), IsEmpty());
  EXPECT_THAT(warnings_of<std::uint32_t>("uint32", [](int n) { return 0x2000000u * n + 1; }),
              IsEmpty());
  EXPECT_THAT(warnings_of<double>("double", [](int n) { return -1000 + 0.1 * n; }), IsEmpty());
  EXPECT_THAT(warnings_of<float>("float", [](int n) { return 1e9F + 64 * static_cast<float>(n); }),
              IsEmpty());
  EXPECT_THAT(
      warnings_of<double>("double", [](int n) { return n == 3 ? static_cast<double>(NAN) : n; }),
      IsEmpty());
}

/// Nor is a constant, which another check refuses.
TEST(RoundingRecord, ConstantsAreReadAsSuch) {
  EXPECT_THAT(warnings_of<double>("double", [](int) { return 1e9 + 1; }), IsEmpty());
}

TEST(RoundingRecord, SamplesOfWhichNothingIsLeftAreRefused) {
  EXPECT_REFUSED(
      warnings_of<std::uint64_t>("uint64", [](int n) { return (1ull << 60) + n; }),
      AllOf(HasSubstr("differ"), HasSubstr("from 1152921504606846976 to 1152921504606847095")));
  EXPECT_REFUSED(warnings_of<double>("double", [](int n) { return n == 3 ? 1e300 : n; }),
                 AllOf(HasSubstr("within single precision"), HasSubstr("1e+300")));
}

/// What other values of a voxel lose is no matter of the one that is read.
TEST(RoundingRecord, OtherChannelsDoNotCount) {
  const TempFolder folder;
  std::string bytes;
  for (int n = 0; n < kRounded; ++n) {
    for (const double value : {1e300, static_cast<double>(n)}) {
      bytes.append(reinterpret_cast<const char*>(&value), sizeof(value));
    }
  }
  write_bytes(folder / "a.nrrd",
              "NRRD0004\ntype: double\ndimension: 4\nsizes: 2 6 5 4\n"
              "space: left-posterior-superior\nspace directions: none (1,0,0) (0,1,0) (0,0,1)\n"
              "kinds: vector domain domain domain\nendian: little\nencoding: raw\n\n" +
                  bytes);
  EXPECT_THAT(read_volume(folder / "a.nrrd", {.channel = 1}).warnings, IsEmpty());
  EXPECT_REFUSED(read_volume(folder / "a.nrrd", {.channel = 0}), HasSubstr("expected"));
}

/// Blocks are noted one after another.
TEST(RoundingRecord, BlocksCountTogether) {
  const RoundingRecord record;
  for (const float value : {1e9F, 1e9F + 6400}) {
    RoundedSamples block;
    block.note(Exact{value} + 20, value);
    block.note(value, value);
    note_rounded(block);
  }
  std::vector<std::string> warnings;
  record.warn("a", warnings);
  EXPECT_THAT(warnings, ElementsAre(HasSubstr("from 1000000000 to 1000006420")));
}

}  // namespace
}  // namespace mesamis
