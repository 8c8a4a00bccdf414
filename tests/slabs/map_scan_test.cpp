// SPDX-License-Identifier: Apache-2.0
#include "mesamis/slabs/map_scan.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <numeric>
#include <vector>

#include "mesamis/base/error.h"
#include "support/temp_folder.h"
#include "support/throws.h"

namespace mesamis {
namespace {

using testing::HasSubstr;

Volume counted(Index slices) {
  Volume volume;
  volume.size = {5, 4, slices};
  volume.spacing = {0.5, 0.5, 2};
  volume.origin = {1, 2, 3};
  volume.samples.resize(volume.voxel_count());
  std::iota(volume.samples.begin(), volume.samples.end(), 0.5F);
  return volume;
}

TEST(MapScan, HasTheSamplesAndThePlaceOfTheScan) {
  const TempFolder temp;
  const Volume volume = counted(9);
  const MappedScan scan = map_scan(VolumeSlices(volume), temp / "");
  EXPECT_EQ(scan.volume.size, volume.size);
  EXPECT_EQ(scan.volume.origin, volume.origin);
  EXPECT_TRUE(std::equal(scan.volume.samples.begin(), scan.volume.samples.end(),
                         volume.samples.begin(), volume.samples.end()));
  EXPECT_TRUE(std::filesystem::is_empty(std::string(temp / ""))) << "the file has no name";
}

/// A scan that cannot be read.
class Broken : public SliceSource {
 public:
  const VoxelGrid& grid() const override { return grid_; }
  std::vector<float> read(Index, Index) const override { throw InputError("scan: broken"); }

 private:
  Volume grid_ = counted(3);
};

TEST(MapScan, LeavesNothingWhereItFails) {
  const TempFolder temp;
  EXPECT_REFUSED(map_scan(Broken(), temp / ""), HasSubstr("broken"));
  EXPECT_TRUE(std::filesystem::is_empty(std::string(temp / "")));
  EXPECT_REFUSED(map_scan(VolumeSlices(counted(3)), temp / "no"), HasSubstr("/no/"));
}

}  // namespace
}  // namespace mesamis
