// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "mesamis/volume_files/read_volume.h"
#include "support/expect_near.h"
#include "support/read_scan.h"
#include "support/temp_folder.h"

namespace mesamis {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

std::string vgi_bytes(const std::string& geometry, const std::string& file = "") {
  return "{volume1}\r\n[representation]\r\nsize = 4 3 5\r\ndatatype = signed integer\r\n"
         "bitsperelement = 16\r\nmirror = 0 0 0\r\n[file1]\r\nFileFormat = raw\r\nSize = 4 3 5\r\n"
         "Name = C:\\scans\\a.vol\r\nDatatype = signed integer\r\nBitsPerElement = 16\r\n" +
         file + "{volumeprimitive1}\r\n[geometry]\r\n" + geometry +
         "[volume]\r\nvolume = volume1\r\n";
}

TEST(Vgi, IsReadByEitherName) {
  const TempFolder folder;
  write_bytes(folder / "a.vgi", vgi_bytes("resolution = 0.5 1.25 2\r\nunit = mm\r\n"));
  write_bytes(folder / "a.vol", bytes_of_all(kRamp));
  for (const char* name : {"a.vgi", "a.vol"}) {
    const VolumeFile file = read_volume(folder / name);
    expect_ramp(file.volume);
    EXPECT_EQ(file.format, "VGI");
    expect_near(file.volume.spacing, {0.5, 1.25, 2});
    EXPECT_THAT(file.warnings, IsEmpty());
  }
  EXPECT_EQ(list_volumes(folder / "").size(), 1u);
}

TEST(Vgi, HonoursUnitsAndWarns) {
  const TempFolder folder;
  write_bytes(folder / "a.vol", bytes_of_all(kRamp));
  const auto with = [&](const std::string& geometry) {
    return read(folder, "a.vgi", vgi_bytes(geometry));
  };
  expect_near(with("resolution = 20 20 40\r\nunit = \xc2\xb5m\r\n").volume.spacing,
              {0.02, 0.02, 0.04});
  EXPECT_THAT(with("resolution = 2 2 4\r\nunit = px\r\n").warnings, ElementsAre(HasSubstr("px")));
  EXPECT_THAT(with("").warnings, ElementsAre(HasSubstr("1 mm assumed")));
}

TEST(Vgi, WarnsOfAPlaceInTheScene) {
  const TempFolder folder;
  write_bytes(folder / "a.vol", bytes_of_all(kRamp));
  const auto warnings = [&](const std::string& field) {
    return read(folder, "a.vgi", vgi_bytes("resolution = 1 1 1\r\nunit = mm\r\n" + field + "\r\n"))
        .warnings;
  };
  for (const char* rest : {"position = 0 0 0", "relativeposition = 0.0 0 0", "scale = 1 1 1.0",
                           "rotate = 1 0 0 0 1 0 0 0 1", "center = 3 4 5"}) {
    EXPECT_THAT(warnings(rest), IsEmpty()) << rest;
  }
  for (const char* moved : {"position = 0 0 7", "relativeposition = 1 0 0", "scale = 1 2 1",
                            "rotate = 0 1 0 1 0 0 0 0 1", "position = here"}) {
    EXPECT_THAT(warnings(moved), ElementsAre(HasSubstr("scene"))) << moved;
  }
}

TEST(Vgi, RefusesWhatItCannotMean) {
  const TempFolder folder;
  EXPECT_THAT(complaint(folder, "a.vgi", vgi_bytes("resolution = 1 1 1\r\n")), HasSubstr("a.vol"));
  write_bytes(folder / "a.vol", bytes_of_all(kRamp) + "x");
  EXPECT_THAT(complaint(folder / "a.vgi"), HasSubstr("go on"));
  write_bytes(folder / "a.vol", bytes_of_all(kRamp));
  EXPECT_THAT(complaint(folder, "a.vgi", "hello"), HasSubstr("sections"));
  EXPECT_THAT(complaint(folder, "a.vgi", vgi_bytes("", "[file2]\r\nName = b.vol\r\n")),
              HasSubstr("several"));
  EXPECT_THAT(complaint(folder, "a.vgi", vgi_bytes("resolution = 0 1 1\r\n")), HasSubstr("axis 0"));
  EXPECT_EQ(read_volume(folder / "a.vgi", {.spacing = Vec3{1, 2, 3}}).volume.spacing,
            (Vec3{1, 2, 3}));
  std::string odd = vgi_bytes("");
  odd.replace(odd.find("Datatype = signed"), 17, "Datatype = motley");
  EXPECT_THAT(complaint(folder, "a.vgi", odd), HasSubstr("motley"));
  EXPECT_NE(complaint(folder, "b.vol", "x"), "");
}

}  // namespace
}  // namespace mesamis
