// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "mesamis/volume_files/read_volume.h"
#include "support/expect_near.h"
#include "support/jpeg_bytes.h"
#include "support/read_scan.h"
#include "support/temp_folder.h"

namespace mesamis {
namespace {

using testing::Contains;
using testing::Each;
using testing::HasSubstr;

/// JFIF's segment: 20 and 40 pixels per centimetre.
std::string with_resolution(const std::string& jpeg) {
  const std::string jfif("JFIF\0\1\1\2\0\x14\0\x28\0\0", 14);
  return jpeg.substr(0, 2) + jpeg_segment(0xe0, jfif) + jpeg.substr(2);
}

TEST(Jpeg, SlicesAreRead) {
  const TempFolder folder;
  for (const int k : {1, 2, 3}) {
    write_bytes(folder / ("s" + std::to_string(k) + ".jpg"), with_resolution(flat_jpeg(8, 50 * k)));
  }
  const VolumeFile file = read_volume(folder / "");
  EXPECT_EQ(file.format, "JPEG slices");
  EXPECT_EQ(file.volume.size, (std::array<Index, 3>{8, 8, 3}));
  expect_near(file.volume.spacing, {0.5, 0.25, 1});
  EXPECT_EQ(file.volume.at(0, 0, 0), 50);
  EXPECT_EQ(file.volume.at(7, 7, 2), 150);
  EXPECT_THAT(file.warnings, Contains(HasSubstr("lossy")));
}

TEST(Jpeg, OneIsASliceWithoutAResolution) {
  const TempFolder folder;
  const VolumeFile file = read(folder, "a.JPEG", flat_jpeg(8, 77));
  EXPECT_THAT(file.volume.samples, Each(77));
  EXPECT_THAT(file.warnings, Contains(HasSubstr("gives no resolution")));
}

TEST(Jpeg, RefusesColoursBrokenFilesAndClaims) {
  const TempFolder folder;
  EXPECT_THAT(complaint(folder, "a.jpg", "x"), HasSubstr("expected a JPEG file"));
  const std::string whole = flat_jpeg(8, 77);
  EXPECT_THAT(complaint(folder, "a.jpg", whole.substr(0, whole.size() - 2)), HasSubstr("cut off"));
  std::string colours = whole;
  colours[colours.find("\xff\xc0") + 9] = 3;
  EXPECT_THAT(complaint(folder, "a.jpg", colours), HasSubstr("3 components"));
  std::string large = whole;
  large.replace(large.find("\xff\xc0") + 5, 4, "\xff\xff\xff\xff");
  EXPECT_THAT(complaint(folder, "a.jpg", large), HasSubstr("65535 x 65535"));
}

}  // namespace
}  // namespace mesamis
