// SPDX-License-Identifier: Apache-2.0
#include "mesamis/volume_files/dicom_phases.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "support/dicom_bytes.h"
#include "support/read_scan.h"
#include "support/throws.h"

namespace mesamis {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::EndsWith;
using testing::HasSubstr;

constexpr std::uint32_t kInstance = 0x00200013, kTrigger = 0x00181060, kEcho = 0x00180081,
                        kTime = 0x00200100;

/// Three phases of four slices, phase p of 100 p and more, in a shuffled order of files.
std::vector<SliceBytes> three_phases() {
  std::vector<SliceBytes> slices;
  for (const int n : {7, 0, 11, 3, 5, 10, 1, 9, 2, 8, 4, 6}) {
    const int phase = n / 4, k = n % 4;
    SliceBytes slice;
    slice.position = {0, 0, 2.0 * k};
    slice.pixels = ramp<std::int16_t>(12, 100 * phase + 12 * k);
    slice.more[kInstance] = {"IS", std::to_string(1 + n)};
    slices.push_back(slice);
  }
  return slices;
}

std::filesystem::path write(const std::filesystem::path& folder,
                            const std::vector<SliceBytes>& slices) {
  for (std::size_t n = 0; n < slices.size(); ++n) {
    write_bytes(folder / (std::to_string(n) + ".dcm"), slices[n].bytes());
  }
  return folder / "";
}

std::filesystem::path write(const TempFolder& folder, const std::vector<SliceBytes>& slices) {
  return write(folder / "", slices);
}

/// The phase that comes out, and the warnings.
VolumeFile phase(const std::filesystem::path& path, Index number) {
  return read_volume(path, {.volume = number});
}

void expect_phases(const std::filesystem::path& path, const std::string& told,
                   const std::vector<std::string>& values = {}) {
  for (Index p = 0; p < 3; ++p) {
    const VolumeFile file = phase(path, p);
    ASSERT_EQ(file.volume.size[2], 4);
    for (std::size_t n = 0; n < file.volume.samples.size(); ++n) {
      ASSERT_EQ(file.volume.samples[n], static_cast<float>(100 * p + static_cast<int>(n)));
    }
    EXPECT_THAT(file.warnings, Contains(HasSubstr(told)));
    if (values.empty()) continue;
    EXPECT_THAT(file.warnings, Contains(EndsWith(" " + values[static_cast<std::size_t>(p)])));
  }
  EXPECT_REFUSED(read_volume(path),
                 AllOf(HasSubstr("3 volumes (--volume 0 to 2)"), HasSubstr(told)));
  EXPECT_REFUSED(phase(path, 3), HasSubstr("found 3"));
  const auto listed = list_volumes(path);
  ASSERT_EQ(listed.size(), 1u);
  EXPECT_THAT(listed[0].problem, HasSubstr("3 volumes"));
}

TEST(DicomPhases, AreToldByATagOfTimes) {
  const TempFolder folder;
  auto slices = three_phases();
  for (SliceBytes& slice : slices) {
    const int number = (std::stoi(slice.more[kInstance].second) - 1) / 4;
    slice.more[kTrigger] = {"DS", std::to_string(90 * number)};  // 0, 90, 180: by size, not text
  }
  expect_phases(write(folder, slices), "Trigger Time");
}

/// Some tags hold no text, but numbers in either precision or whole ones of 32 bits.
TEST(DicomPhases, HaveValuesInAnyFormOfNumber) {
  constexpr std::uint32_t kPercentage = 0x00209241, kIndex = 0x00209128, kWeight = 0x00189087;
  const TempFolder folder;
  auto percent = three_phases(), index = percent, weight = percent;
  for (std::size_t n = 0; n < percent.size(); ++n) {
    const int number = (std::stoi(percent[n].more[kInstance].second) - 1) / 4;
    percent[n].more[kPercentage] = {"FL", bytes_of(12.5F * static_cast<float>(number))};
    weight[n].more[kWeight] = {"FD", bytes_of(500.5 * number)};
    index[n].more[kIndex] = {"UL", bytes_of(static_cast<std::uint32_t>(8 + 2 * number))};
  }
  std::filesystem::create_directories(folder / "percent");
  std::filesystem::create_directories(folder / "index");
  std::filesystem::create_directories(folder / "weight");
  expect_phases(write(folder / "percent", percent), "Nominal Percentage of Cardiac Phase",
                {"0", "12.5", "25"});
  expect_phases(write(folder / "index", index), "Temporal Position Index", {"8", "10", "12"});
  expect_phases(write(folder / "weight", weight), "Diffusion b-value", {"0", "500.5", "1001"});
}

TEST(DicomPhases, AreToldByTwoTagsTogether) {
  const TempFolder folder;
  auto slices = three_phases();
  const char* times[] = {"1", "1", "2"};
  const char* echoes[] = {"5", "7", "5"};
  for (SliceBytes& slice : slices) {
    const int number = (std::stoi(slice.more[kInstance].second) - 1) / 4;
    slice.more[kTime] = {"IS", times[number]};
    slice.more[kEcho] = {"DS", echoes[number]};
  }
  expect_phases(write(folder, slices), "Temporal Position Identifier and Echo Time");
}

TEST(DicomPhases, AreElseThoseOfTheInstanceNumbers) {
  const TempFolder folder;
  expect_phases(write(folder, three_phases()), "order of Instance Numbers");
}

TEST(DicomPhases, NeedEveryPlaceEquallyOften) {
  const TempFolder folder;
  auto slices = three_phases();
  slices.pop_back();
  EXPECT_REFUSED(phase(write(folder, slices), 0), HasSubstr("found two at the same"));
}

TEST(DicomPhases, OfASeriesWithOneAreNone) {
  const TempFolder folder;
  auto slices = three_phases();
  std::erase_if(slices, [](SliceBytes& s) { return std::stoi(s.more[kInstance].second) > 4; });
  const auto path = write(folder, slices);
  EXPECT_EQ(read_volume(path).volume.samples, phase(path, 0).volume.samples);
  EXPECT_REFUSED(phase(path, 1), HasSubstr("found 1"));
}

}  // namespace
}  // namespace mesamis
