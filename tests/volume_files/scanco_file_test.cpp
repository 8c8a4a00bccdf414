// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <string>

#include "mesamis/volume_files/read_volume.h"
#include "support/expect_near.h"
#include "support/read_scan.h"
#include "support/temp_folder.h"

namespace mesamis {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

/// 4 x 3 x 5 voxels of 0.5 x 1.25 x 2 mm; one block of an extended header.
std::string isq_bytes(std::int32_t type = 3, std::int32_t um_z = 10000) {
  std::string h(1024, '\0');
  h.replace(0, 16, "CTDATA-HEADER_V1");
  const auto put = [&h](std::size_t at, std::int32_t value) { h.replace(at, 4, bytes_of(value)); };
  put(16, type);
  put(44, 4), put(48, 3), put(52, 5);
  put(56, 2000), put(60, 3750), put(64, um_z);
  put(508, 1);
  return h + bytes_of_all(kRamp);
}

/// As VAX stores a number: halves exchanged, two more in the exponent.
std::string vax(float value) {
  const auto bits = std::bit_cast<std::uint32_t>(4 * value);
  return bytes_of(bits << 16 | bits >> 16);
}

struct AimBytes {
  std::int32_t type = 0x00020002;
  std::string log = "Mu_Scaling   4096\n";
  std::string samples = bytes_of_all(kRamp);

  std::string bytes(bool wide) const {
    const auto number = [wide](std::int64_t n) {
      return wide ? bytes_of(n) : bytes_of(static_cast<std::int32_t>(n));
    };
    std::string out = wide ? std::string("AIMDATA_V030   \0", 16) : "";
    std::string described(wide ? 12 : 20, '\0');
    described += bytes_of(type);
    for (const int n : {7, 8, 9, 4, 3, 5}) described += number(n);
    for (int n = 0; n < 15; ++n) described += number(0);
    for (const double mm : {0.5, 1.25, 2.0}) {
      described += wide ? number(static_cast<std::int64_t>(mm * 1e6)) : vax(static_cast<float>(mm));
    }
    described.resize(wide ? 224 : 140);
    for (const auto n : {std::size_t{wide ? 40U : 20U}, described.size(), log.size(),
                         samples.size(), std::size_t{0}}) {
      out += number(static_cast<std::int64_t>(n));
    }
    return out + described + log + samples;
  }
};

TEST(Isq, IsRead) {
  const TempFolder folder;
  const VolumeFile file = read(folder, "a.isq", isq_bytes());
  expect_ramp(file.volume);
  EXPECT_EQ(file.format, "ISQ");
  expect_near(file.volume.spacing, {0.5, 1.25, 2});
  EXPECT_THAT(file.warnings, ElementsAre(HasSubstr("no Hounsfield units")));
  expect_ramp(read(folder, "b.ISQ;1", isq_bytes()).volume);
}

TEST(Isq, RefusesOtherFiles) {
  const TempFolder folder;
  EXPECT_THAT(complaint(folder, "a.isq", "x"), HasSubstr("expected an ISQ file"));
  EXPECT_THAT(complaint(folder, "a.isq", isq_bytes(5)), HasSubstr("data type 5"));
  EXPECT_THAT(complaint(folder, "a.isq", isq_bytes(3, 0)), HasSubstr("axis 2"));
  EXPECT_EQ(read_volume(folder / "a.isq", {.spacing = Vec3{1, 2, 3}}).volume.spacing,
            (Vec3{1, 2, 3}));
  const std::string whole = isq_bytes();
  EXPECT_THAT(complaint(folder, "a.isq", whole.substr(0, whole.size() - 1)), HasSubstr("bytes"));
}

TEST(Aim, IsReadInBothVersions) {
  const TempFolder folder;
  for (const bool wide : {false, true}) {
    const VolumeFile file = read(folder, "a.AIM", AimBytes{}.bytes(wide));
    expect_ramp(file.volume);
    EXPECT_EQ(file.format, "AIM");
    expect_near(file.volume.spacing, {0.5, 1.25, 2});
    expect_near(file.volume.origin, {3.5, 10, 18});
    AimBytes mask;
    mask.type = 0x00010001;
    mask.samples = std::string(60, '\x7f');
    const VolumeFile binary = read(folder, "b.aim", mask.bytes(wide));
    EXPECT_EQ(binary.volume.samples[59], 127);
    EXPECT_THAT(binary.warnings, testing::IsEmpty());
  }
}

TEST(Aim, RefusesOtherFiles) {
  const TempFolder folder;
  EXPECT_THAT(complaint(folder, "a.aim", "x"), HasSubstr("expected an AIM file"));
  EXPECT_THAT(complaint(folder, "a.aim", std::string("AIMDATA_V030   \0", 16)),
              HasSubstr("expected an AIM file"));
  AimBytes packed_bits;
  packed_bits.type = 0x00150001;
  EXPECT_THAT(complaint(folder, "a.aim", packed_bits.bytes(false)), HasSubstr("uncompressed"));
  const std::string whole = AimBytes{}.bytes(true);
  EXPECT_THAT(complaint(folder, "a.aim", whole.substr(0, whole.size() - 1)), HasSubstr("bytes"));
}

}  // namespace
}  // namespace mesamis
