// SPDX-License-Identifier: Apache-2.0
#include "mesamis/volume_files/skyscan_log.h"

#include <gtest/gtest.h>

#include "support/expect_near.h"
#include "support/temp_folder.h"

namespace mesamis {
namespace {

TEST(SkyscanLog, IsTheOneOfTheReconstruction) {
  const TempFolder folder;
  EXPECT_FALSE(find_skyscan_log(folder.path()));
  write_bytes(folder / "a.log", "[Acquisition]\nPixel Size (um)=99\n");
  write_bytes(folder / "b.log", std::string(2'000'000, 'x'));
  EXPECT_FALSE(find_skyscan_log(folder.path()));
  write_bytes(folder / "c.LOG", "[Reconstruction]\nPixel Size (um)=8.75\n");
  const auto log = find_skyscan_log(folder.path());
  ASSERT_TRUE(log);
  EXPECT_EQ(log->file, folder / "c.LOG");
  expect_near(log->spacing, {0.00875, 0.00875, 0.00875});
}

TEST(SkyscanLog, WithoutALengthIsNone) {
  const TempFolder folder;
  for (const char* size : {"", "0", "-3", "nan", "inf", "wide"}) {
    write_bytes(folder / "a.log", "[Reconstruction]\nPixel Size (um)=" + std::string(size) + "\n");
    EXPECT_FALSE(find_skyscan_log(folder.path())) << size;
  }
}

TEST(SkyscanLog, AScoutIsKnownByItsName) {
  EXPECT_TRUE(is_scout("dir/a_rec_spr.bmp"));
  EXPECT_TRUE(is_scout("a_REC_SPR.tif"));
  EXPECT_FALSE(is_scout("a_rec0001.bmp"));
  EXPECT_FALSE(is_scout("spring.bmp"));
}

}  // namespace
}  // namespace mesamis
