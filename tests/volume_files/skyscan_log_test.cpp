// SPDX-License-Identifier: Apache-2.0
#include "mesamis/volume_files/skyscan_log.h"

#include <gmock/gmock.h>

#include "mesamis/base/message.h"
#include "support/expect_near.h"
#include "support/temp_folder.h"

namespace mesamis {
namespace {

TEST(SkyscanLog, IsTheOneOfTheReconstruction) {
  const TempFolder folder;
  EXPECT_FALSE(find_skyscan_log(folder.path()));
  write_bytes(folder / "b.log", std::string(2'000'000, 'x'));
  EXPECT_FALSE(find_skyscan_log(folder.path()));
  write_bytes(folder / "a.log", "[Acquisition]\nPixel Size (um)=99\n");
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

TEST(SkyscanLog, KnowsTheFieldsOfOtherVersions) {
  const TempFolder folder;
  for (const char* field :
       {"Pixel Size (um)=8,75", "Image Pixel Size (um)= 8.75", "Image Pixel Size=8.75 um",
        "Pixel Size (\xb5m)=8.75", "Image Pixel Size (mm)=0.00875", "PIXEL SIZE=0.00875mm"}) {
    write_bytes(folder / "a.log", message("[Reconstruction]\r\n", field, "\r\n"));
    const auto log = find_skyscan_log(folder.path());
    ASSERT_TRUE(log) << field;
    expect_near(log->spacing, {0.00875, 0.00875, 0.00875});
    EXPECT_TRUE(log->warnings.empty());
  }
  for (const char* field : {"Image Pixel Size=8.75", "Pixel Size (kV)=3", "Pixel Size of=3 um"}) {
    write_bytes(folder / "a.log", message("[Reconstruction]\n", field, "\n"));
    EXPECT_FALSE(find_skyscan_log(folder.path())) << field;
  }
}

/// Scanners bin before they state the pixels of the image: those of the camera do not count.
TEST(SkyscanLog, OfProjectionsAloneGivesAWarning) {
  const TempFolder folder;
  write_bytes(folder / "a.log",
              "[Acquisition]\nCamera binning=2x2\nCamera Pixel Size (um)=7.4\nNumber of Rows= 20\n"
              "Number of Columns= 30\nImage Pixel Size (um)=17.5\n");
  const auto log = find_skyscan_log(folder.path());
  ASSERT_TRUE(log);
  expect_near(log->spacing, {0.0175, 0.0175, 0.0175});
  EXPECT_FALSE(log->reconstructed);
  EXPECT_EQ(log->size, (std::array<std::int64_t, 2>{30, 20}));
  ASSERT_EQ(log->warnings.size(), 1u);
  EXPECT_THAT(log->warnings[0], testing::HasSubstr("pixels of projections alone"));
}

TEST(SkyscanLog, OfSeveralThatOfThePictureIsTaken) {
  const TempFolder folder;
  const auto write = [&](const char* name, int size) {
    write_bytes(folder / name, message("[Acquisition]\nImage Pixel Size (um)=9\n[Reconstruction]\n",
                                       "Pixel Size (um)=", size, "\n"));
  };
  write_bytes(folder / "a.log", "[Acquisition]\nImage Pixel Size (um)=9\n");
  write("a_rec.log", 10);
  write("b_rec.log", 20);
  const auto of_b = find_skyscan_log(folder.path(), "b_rec0001.bmp");
  ASSERT_TRUE(of_b);
  EXPECT_EQ(of_b->file, folder / "b_rec.log");
  EXPECT_TRUE(of_b->warnings.empty());
  const auto any = find_skyscan_log(folder.path(), "slice0001.bmp");
  ASSERT_TRUE(any);
  EXPECT_EQ(any->file, folder / "a_rec.log");
  ASSERT_EQ(any->warnings.size(), 1u);
  EXPECT_THAT(any->warnings[0], testing::HasSubstr("b_rec.log states another spacing"));
}

TEST(SkyscanLog, AScoutIsKnownByItsName) {
  EXPECT_TRUE(is_scout("dir/a_rec_spr.bmp"));
  EXPECT_TRUE(is_scout("a_REC_SPR.tif"));
  EXPECT_FALSE(is_scout("a_rec0001.bmp"));
  EXPECT_FALSE(is_scout("spring.bmp"));
}

}  // namespace
}  // namespace mesamis
