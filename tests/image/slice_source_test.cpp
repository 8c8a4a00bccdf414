// SPDX-License-Identifier: Apache-2.0
#include "mesamis/image/slice_source.h"

#include <gtest/gtest.h>

#include <numeric>

namespace mesamis {
namespace {

Volume counted(const std::array<Index, 3>& size) {
  Volume volume;
  volume.size = size;
  volume.spacing = {0.5, 1, 2};
  volume.origin = {10, 20, 30};
  volume.direction = {{Vec3{0, 1, 0}, Vec3{1, 0, 0}, Vec3{0, 0, -1}}};
  volume.samples.resize(volume.voxel_count());
  std::iota(volume.samples.begin(), volume.samples.end(), 0.0F);
  return volume;
}

TEST(ReadSlab, HoldsItsSlicesWhereTheyLieInTheWorld) {
  const Volume whole = counted({3, 4, 7});
  const Volume slab = read_slab(VolumeSlices(whole), 2, 3);
  EXPECT_EQ(slab.size, (std::array<Index, 3>{3, 4, 3}));
  ASSERT_EQ(slab.samples.size(), slab.voxel_count());
  for (Index k = 0; k < 3; ++k) {
    EXPECT_EQ(slab.at(1, 2, k), whole.at(1, 2, k + 2));
    EXPECT_LT(norm(slab.to_world({0.5, 2, 2.0 * k}) - whole.to_world({0.5, 2, 2.0 * (k + 2)})),
              1e-12);
  }
}

TEST(ReadSlab, AllSlabsAreTheVolume) {
  const Volume whole = counted({3, 4, 7});
  const VolumeSlices source(whole);
  std::vector<float> joined;
  for (const auto& [first, count] : {std::pair<Index, Index>{0, 3}, {3, 1}, {4, 3}}) {
    const Volume slab = read_slab(source, first, count);
    joined.insert(joined.end(), slab.samples.begin(), slab.samples.end());
  }
  EXPECT_EQ(joined, whole.samples);
}

TEST(SlabSlices, AreManyInSmallVolumesAndAtLeastOneInHugeOnes) {
  EXPECT_EQ(slab_slices({.size = {100, 100, 70}}), 70);
  EXPECT_EQ(slab_slices({.size = {1024, 1024, 1024}}), 64);
  EXPECT_EQ(slab_slices({.size = {50'000, 50'000, 50'000}}), 1);
  EXPECT_EQ(slab_slices({.size = {1024, 1024, 1024}}, 100), 100);
  EXPECT_EQ(slab_slices({.size = {1024, 1024, 80}}, 100), 80);
}

}  // namespace
}  // namespace mesamis
