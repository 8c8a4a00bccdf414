// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <string>

#include "mesamis/volume_files/read_volume.h"
#include "support/expect_near.h"
#include "support/read_scan.h"
#include "support/throws.h"

namespace mesamis {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

VolumeFile read_raw(const TempFolder& folder, const std::string& layout, const std::string& bytes,
                    std::optional<Vec3> spacing = {}) {
  write_bytes(folder / "a.raw", bytes);
  return read_volume(folder / "a.raw", {.raw = parse_raw_layout(layout), .spacing = spacing});
}

template <class Number>
void expect_type(const std::string& name, const std::vector<Number>& values) {
  const TempFolder folder;
  const std::vector<float> expected(values.begin(), values.end());
  const std::string n = std::to_string(values.size()) + ",1,1,";
  EXPECT_EQ(read_raw(folder, n + name, bytes_of_all(values)).volume.samples, expected) << name;
  EXPECT_EQ(read_raw(folder, n + name + "le", bytes_of_all(values)).volume.samples, expected);
  EXPECT_EQ(read_raw(folder, n + name + "be", bytes_of_all(values, true)).volume.samples, expected);
}

TEST(Raw, ReadsEveryTypeInBothByteOrders) {
  expect_type<std::uint8_t>("uint8", {0, 200, 255});
  expect_type<std::int16_t>("int16", {-1024, 3071, 7});
  expect_type<std::uint16_t>("uint16", {40000, 1});
  expect_type<std::int32_t>("int32", {-70000, 1 << 20});
  expect_type<float>("float32", {0.25F, -1e10F});
  expect_type<double>("float64", {0.5, -1e10});
}

TEST(Raw, SkipsAHeaderAndTakesTheSpacing) {
  const TempFolder folder;
  const VolumeFile file =
      read_raw(folder, "4,3,5,int16,7", "header!" + bytes_of_all(kRamp), Vec3{0.5, 1.25, 2});
  expect_ramp(file.volume);
  expect_near(file.volume.spacing, {0.5, 1.25, 2});
  EXPECT_EQ(file.format, "raw");
  EXPECT_THAT(file.warnings, IsEmpty());
}

TEST(Raw, WithoutASpacingOneMillimetreIsTakenWithAWarning) {
  const TempFolder folder;
  EXPECT_THAT(read_raw(folder, "4,3,5,int16", bytes_of_all(kRamp)).warnings,
              ElementsAre(HasSubstr("1 mm assumed")));
}

TEST(Raw, RefusesAFileOfAnotherSizeBeforeItIsRead) {
  const TempFolder folder;
  const std::string bytes = bytes_of_all(kRamp);
  EXPECT_REFUSED(read_raw(folder, "4,3,6,int16", bytes),
                 HasSubstr("a.raw: expected 144 bytes, 0 of header and 144 of 4 x 3 x 6 samples, "
                           "found 120"));
  EXPECT_REFUSED(read_raw(folder, "4,3,5,int16", bytes + "x"), HasSubstr("found 121"));
  EXPECT_REFUSED(read_raw(folder, "4,3,5,int16,1", bytes), HasSubstr("expected 121 bytes"));
  // Products and sums beyond 32 and 64 bits.
  const double before = peak_mb();
  EXPECT_REFUSED(read_raw(folder, "65536,65536,64,float64", bytes),
                 HasSubstr("expected 2199023255552 bytes"));
  EXPECT_REFUSED(read_raw(folder, "2147483647,2147483647,2147483647,float64", bytes),
                 HasSubstr("more voxels than can be read"));
  EXPECT_REFUSED(read_raw(folder, "4294967297,1,1,uint8", bytes), HasSubstr("along axis 0"));
  EXPECT_REFUSED(read_raw(folder, "4,3,5,int16,9223372036854775807", bytes),
                 HasSubstr("expected 9223372036854775927 bytes"));
  EXPECT_LT(peak_mb() - before, 50);
}

TEST(RawLayout, RefusesWhatIsNone) {
  for (const char* text : {"", "4,3,5", "4,3,int16", "4,3,5,int24", "4,3,5,int16,", "0,3,5,int16",
                           "-1,3,5,int16", "4,3,5,int16,-1", "4,3,5,int16,1,1", "4,3,5.5,int16",
                           "4,3,99999999999999999999,int16", "4,3,5,int16ee", "4, 3,5,int16"}) {
    EXPECT_REFUSED((void)parse_raw_layout(text), HasSubstr("NX,NY,NZ,TYPE"));
  }
}

TEST(RawLayout, GoesForTheListToo) {
  const TempFolder folder;
  write_bytes(folder / "a.bin", bytes_of_all(kRamp));
  const auto infos = list_volumes(folder / "a.bin", {.raw = parse_raw_layout("4,3,5,int16")});
  ASSERT_EQ(infos.size(), 1U);
  EXPECT_EQ(infos[0].size, (std::array<Index, 3>{4, 3, 5}));
  EXPECT_EQ(infos[0].problem, "");
  EXPECT_THAT(list_volumes(folder / "a.bin", {.raw = parse_raw_layout("4,3,4,int16")})[0].problem,
              HasSubstr("expected 96 bytes"));
}

}  // namespace
}  // namespace mesamis
