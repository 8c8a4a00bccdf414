// SPDX-License-Identifier: Apache-2.0
#include "mesamis/volume_files/dicom_store.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "support/dicom_bytes.h"
#include "support/read_scan.h"
#include "support/throws.h"
#include "support/wide_budget.h"
#include "support/zip_bytes.h"

namespace mesamis {
namespace {

using testing::HasSubstr;

std::string slice_at(int k) {
  SliceBytes slice;
  slice.position = {0, 0, 2.0 * k};
  slice.pixels = ramp<std::int16_t>(12, -40 + 12 * k);
  return slice.bytes();
}

std::string zipped_series(bool deflated = true) {
  std::vector<std::pair<std::string, std::string>> parts{{"Series/", ""}, {"read me.txt", "hello"}};
  for (const int k : {4, 0, 3, 1, 2})
    parts.emplace_back("Series/IM" + std::to_string(k), slice_at(k));
  return zip_bytes(parts, deflated);
}

TEST(DicomStore, OfAnArchiveHoldsItsFiles) {
  const TempFolder folder;
  for (const bool deflated : {true, false}) {
    const VolumeFile file = read(folder, "a.zip", zipped_series(deflated));
    expect_ramp(file.volume);
    EXPECT_EQ(file.format, "DICOM");
    EXPECT_NEAR(file.volume.spacing.z, 2, 1e-12);
  }
  const auto listed = list_volumes(folder / "a.zip");
  ASSERT_EQ(listed.size(), 1u);
  EXPECT_EQ(listed[0].size, (std::array<Index, 3>{4, 3, 5}));
}

TEST(DicomStore, RefusesArchivesWithoutASeries) {
  const TempFolder folder;
  write_bytes(folder / "a.zip", zip_bytes({{"a.txt", "hello"}}));
  EXPECT_REFUSED(list_volumes(folder / "a.zip"), HasSubstr("expected DICOM images, found none"));
  EXPECT_THAT(complaint(folder, "a.zip", zip_bytes({{"a.txt", "hello"}})),
              HasSubstr("expected DICOM images"));
  const std::string whole = zipped_series();
  EXPECT_NE(complaint(folder, "a.zip", whole.substr(0, whole.size() / 2)), "");
  EXPECT_NE(complaint(folder, "a.zip", "PK but no archive"), "");
}

TEST(DicomStore, OfAFolderFollowsLinks) {
  const TempFolder folder, elsewhere;
  for (int k = 0; k < 5; ++k) write_bytes(elsewhere / std::to_string(k), slice_at(k));
  std::filesystem::create_directory(folder / "scan");
  std::filesystem::create_directory_symlink(elsewhere.path(), folder / "scan/series");
  expect_ramp(read_volume(folder / "scan").volume);
  WideBudget budget;
  EXPECT_EQ(DicomStore(folder / "scan", budget).files().size(), 5u);
}

}  // namespace
}  // namespace mesamis
