// SPDX-License-Identifier: Apache-2.0
#include "mesamis/page/scan_copy.h"

#include <gtest/gtest.h>

#include <cmath>

#include "mesamis/volume_files/read_volume.h"
#include "page/unpacked.h"
#include "support/sampled_volume.h"
#include "support/temp_folder.h"

namespace mesamis {
namespace {

Volume oblique() {
  Volume scan = sampled_volume({24, 20, 16}, {0.5, 1, 2},
                               [](const Vec3& p) { return 40 * std::sin(p.x) + 30 * p.y - p.z; });
  const double c = std::cos(0.3), s = std::sin(0.3);
  scan.direction = {{Vec3{c, -s, 0}, Vec3{s, c, 0}, Vec3{0, 0, 1}}};
  scan.origin = {-12, 34, 5};
  return scan;
}

Volume read_back(const TempFolder& folder, const ScanCopy& copy) {
  write_bytes(folder / "copy.nii.gz", copy.nifti_gz);
  return read_volume(folder / "copy.nii.gz", {}).volume;
}

TEST(ScanCopy, HasTheValuesInTheirPlaces) {
  const TempFolder folder;
  const Volume scan = oblique();
  const ScanCopy copy = scan_copy(scan, {0, 100}, 1'000'000);
  EXPECT_EQ(copy.block, (std::array<Index, 3>{1, 1, 1}));
  const Volume back = read_back(folder, copy);
  ASSERT_EQ(back.size, scan.size);
  EXPECT_NEAR(norm(back.origin - scan.origin), 0, 1e-5);
  const Vec3 corner = scan.box().hi;
  EXPECT_NEAR(norm(back.to_world(corner) - scan.to_world(corner)), 0, 1e-4);
  const double step = (copy.high - copy.low) / 255;
  int beyond = 0;
  for (std::size_t n = 0; n < scan.samples.size(); ++n) {
    beyond += std::abs(back.samples[n] - scan.samples[n]) > 0.51 * step;
  }
  EXPECT_LE(beyond, static_cast<int>(scan.samples.size() / 400)) << "the outermost two thousandths";
}

TEST(ScanCopy, IsThinnedToMeansOfBlocksUntilItFits) {
  const TempFolder folder;
  const Volume scan = oblique();
  const ScanCopy copy = scan_copy(scan, {0, 100}, 1500);
  EXPECT_LE(copy.nifti_gz.size(), 1500u);
  EXPECT_GT(copy.block[0], copy.block[2]) << "the shortest sides first";
  const Volume back = read_back(folder, copy);
  const Vec3 first{0.5 * (copy.block[0] - 1) * 0.5, 0.5 * (copy.block[1] - 1), copy.block[2] - 1.0};
  EXPECT_NEAR(norm(back.origin - scan.to_world(first)), 0, 1e-4) << "the middle of the first block";
}

TEST(ScanCopy, HoldsNoWordsAndIsTheSameEveryTime) {
  Volume scan = oblique();
  scan.modality = "UNMISTAKABLE";
  const std::string bytes = scan_copy(scan, {0, 1}, 100'000).nifti_gz;
  EXPECT_EQ(bytes, scan_copy(scan, {0, 1}, 100'000).nifti_gz);
  const std::string header = unpacked(bytes).substr(0, 352);
  for (std::size_t n = 124; n < 252; ++n) EXPECT_EQ(header[n], '\0') << n;
}

}  // namespace
}  // namespace mesamis
