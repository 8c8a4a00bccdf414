// SPDX-License-Identifier: Apache-2.0
#include "mesamis/volume_files/sidecar.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "mesamis/volume_files/read_volume.h"
#include "support/read_scan.h"
#include "support/temp_folder.h"

namespace mesamis {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;

VolumeFile with_sidecar(const std::string& json, const ReadOptions& options = {}) {
  const TempFolder folder;
  write_bytes(folder / "sub-01_ct.json", json);
  write_bytes(folder / "sub-01_ct.nii.gz", packed(NiftiBytes{}.header() + bytes_of_all(kRamp)));
  return read_volume(folder / "sub-01_ct.nii.gz", options);
}

TEST(Sidecar, StatesTheModality) {
  EXPECT_EQ(with_sidecar(R"({"Modality": "CT", "KVP": 120})").volume.modality, "CT");
  EXPECT_EQ(with_sidecar(R"({"Modality": "MR"})").volume.modality, "MR");
  EXPECT_EQ(with_sidecar(R"({"Modality": "ct"})").volume.modality, "CT");
  EXPECT_EQ(with_sidecar(R"({"KVP": 120})").volume.modality, "");
}

TEST(Sidecar, ThatCannotBeReadDoesNotCount) {
  for (const char* json : {"{", "[1]", R"({"Modality": 7})"}) {
    const VolumeFile file = with_sidecar(json);
    EXPECT_EQ(file.volume.modality, "") << json;
    if (std::string(json) != "[1]") {
      EXPECT_THAT(file.warnings, Contains(HasSubstr("sub-01_ct.json"))) << json;
    }
  }
}

TEST(Sidecar, IsOverruledByTheFileAndTheUser) {
  const TempFolder folder;
  write_bytes(folder / "a.json", R"({"Modality": "MR"})");
  EXPECT_EQ(read(folder, "a.mha", meta_bytes("") + bytes_of_all(kRamp)).volume.modality, "CT");
  EXPECT_EQ(with_sidecar(R"({"Modality": "MR"})", {.modality = "CT"}).volume.modality, "CT");
}

TEST(Modality, IsTheOneGiven) {
  const TempFolder folder;
  write_bytes(folder / "a.mha", meta_bytes("") + bytes_of_all(kRamp));
  EXPECT_EQ(read_volume(folder / "a.mha", {.modality = "other"}).volume.modality, "other");
  EXPECT_EQ(read_grid(folder / "a.mha", {.modality = "MR"}).modality, "MR");
  EXPECT_EQ(list_volumes(folder / "a.mha", {.modality = "MR"})[0].modality, "MR");
  EXPECT_THROW(read_volume(folder / "a.mha", {.modality = "ct"}), InputError);
}

}  // namespace
}  // namespace mesamis
