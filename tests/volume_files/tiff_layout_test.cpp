// SPDX-License-Identifier: Apache-2.0
#include "mesamis/volume_files/tiff_layout.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "support/expect_near.h"
#include "support/throws.h"
#include "support/wide_budget.h"

namespace mesamis {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

TiffLayout layout(const std::string& text, std::int64_t pages, std::int64_t most = 0) {
  WideBudget budget;
  return read_tiff_layout("dir/a.tif", text, pages, most, budget);
}

std::string ome(const std::string& pixels, const std::string& content = "") {
  return "<?xml version=\"1.0\"?><OME xmlns=\"http://www.openmicroscopy.org/Schemas/OME/2016-06\">"
         "<Image ID=\"Image:0\"><Pixels ID=\"Pixels:0\" SizeX=\"4\" SizeY=\"3\" " +
         pixels + ">" + content + "</Pixels></Image></OME>";
}

TEST(TiffLayout, TakesAllPagesAsSlicesWithoutADescription) {
  for (const char* text : {"", "a rock", "<svg/>", "{\"shape\": [5, 3, 4]}"}) {
    const TiffLayout found = layout(text, 5);
    EXPECT_EQ(found.slices, 5) << text;
    EXPECT_EQ(found.axes.volumes, 1);
    EXPECT_EQ(found.axes.channels, 1);
    EXPECT_THAT(found.planes, ElementsAre(0, 1, 2, 3, 4));
    EXPECT_THAT(found.warnings, IsEmpty());
  }
}

TEST(TiffLayout, ChannelsOfImageJRunFastestThenSlicesThenFrames) {
  const TiffLayout found =
      layout("ImageJ=1.53\nimages=12\nchannels=2\nslices=3\nframes=2\nunit=um\nspacing=-2.5\n", 12);
  EXPECT_EQ(found.slices, 3);
  EXPECT_EQ(found.axes.channels, 2);
  EXPECT_EQ(found.axes.volumes, 2);
  EXPECT_THAT(found.planes, ElementsAre(0, 2, 4, 6, 8, 10, 1, 3, 5, 7, 9, 11));
  EXPECT_EQ(found.unit, "um");
  EXPECT_EQ(found.between, 2.5);
}

TEST(TiffLayout, ValuesOfImageJLieOnALine) {
  const TiffLayout line = layout("ImageJ=1.53\nimages=5\nslices=5\ncf=0\nc0=-32768\nc1=0.5\n", 5);
  EXPECT_EQ(line.intercept, -32768);
  EXPECT_EQ(line.slope, 0.5);
  EXPECT_THAT(line.warnings, IsEmpty());
  const TiffLayout curve = layout("ImageJ=1.53\nimages=5\nslices=5\ncf=4\nc0=1\nc1=2\n", 5);
  EXPECT_EQ(curve.slope, 1);
  EXPECT_EQ(curve.intercept, 0);
  EXPECT_THAT(curve.warnings, ElementsAre(HasSubstr("cf=4")));
}

TEST(TiffLayout, ImagesOfImageJMayLieBehindOneDirectory) {
  const TiffLayout found = layout("ImageJ=1.53\nimages=5\nslices=5\n", 1, 7);
  EXPECT_TRUE(found.one_directory);
  EXPECT_THAT(found.planes, ElementsAre(0, 1, 2, 3, 4));
  const TiffLayout slice = layout("ImageJ=1.53\nimages=5\nslices=5\n", 1, 1);
  EXPECT_EQ(slice.slices, 1) << "the file cannot hold five";
  EXPECT_THAT(slice.warnings, ElementsAre(HasSubstr("5 images")));
}

TEST(TiffLayout, TimesOfOneSliceAreSlices) {
  for (const std::string& text :
       {std::string("ImageJ=1.53\nimages=5\nframes=5\n"),
        ome("SizeZ=\"1\" SizeT=\"5\" SizeC=\"1\" DimensionOrder=\"XYZCT\"", "<TiffData/>")}) {
    const TiffLayout found = layout(text, 5);
    EXPECT_EQ(found.slices, 5);
    EXPECT_EQ(found.axes.volumes, 1);
    EXPECT_THAT(found.planes, ElementsAre(0, 1, 2, 3, 4));
    EXPECT_THAT(found.warnings, Contains(HasSubstr("taken as slices")));
  }
}

TEST(TiffLayout, TimesOfOneSliceAreSlicesOfEachChannel) {
  const TiffLayout found = layout("ImageJ=1.53\nimages=6\nchannels=2\nframes=3\n", 6);
  EXPECT_EQ(found.slices, 3);
  EXPECT_EQ(found.axes.volumes, 1);
  EXPECT_EQ(found.axes.channels, 2);
  EXPECT_THAT(found.planes, ElementsAre(0, 2, 4, 1, 3, 5));
  EXPECT_THAT(found.warnings, Contains(HasSubstr("3 times of one slice each")));
}

/// tifffile calls the first of three axes channels where it is told nothing of them.
TEST(TiffLayout, ManyChannelsOfOneSliceAreSlices) {
  for (const std::string& text :
       {std::string("ImageJ=1.11a\nimages=8\nchannels=8\nhyperstack=true\n"),
        ome("SizeZ=\"1\" SizeT=\"1\" SizeC=\"8\" DimensionOrder=\"XYCZT\"", "<TiffData/>"),
        std::string("{\"shape\": [8, 3, 4], \"axes\": \"CYX\"}")}) {
    const TiffLayout found = layout(text, 8);
    EXPECT_EQ(found.slices, 8) << text;
    EXPECT_EQ(found.axes.channels, 1);
    EXPECT_THAT(found.planes, ElementsAre(0, 1, 2, 3, 4, 5, 6, 7));
    EXPECT_THAT(found.warnings, Contains(HasSubstr("8 channels of one slice each")));
  }
  EXPECT_EQ(layout("ImageJ=1.53\nimages=7\nchannels=7\n", 7).axes.channels, 7);
}

TEST(TiffLayout, OmeHasSizesInItsUnits) {
  const TiffLayout found = layout(
      ome("SizeZ=\"2\" SizeT=\"1\" SizeC=\"1\" DimensionOrder=\"XYZCT\" PhysicalSizeX=\"500\" "
          "PhysicalSizeY=\"0.5\" PhysicalSizeYUnit=\"mm\" PhysicalSizeZ=\"2000\" "
          "PhysicalSizeZUnit=\"nm\""),
      2);
  expect_near(found.spacing, {0.5, 0.5, 0.002});
  const TiffLayout pixel = layout(
      ome("SizeZ=\"2\" DimensionOrder=\"XYZCT\" PhysicalSizeX=\"2\" PhysicalSizeXUnit=\"pixel\""),
      2);
  EXPECT_EQ(pixel.spacing.x, 0);
  EXPECT_THAT(pixel.warnings, ElementsAre(HasSubstr("pixel")));
}

TEST(TiffLayout, OmeOrdersItsPlanes) {
  const std::string sizes = "SizeZ=\"2\" SizeT=\"2\" SizeC=\"2\" DimensionOrder=";
  // (channel, volume, slice): 000, 001, 010, 011, 100, ...
  EXPECT_THAT(layout(ome(sizes + "\"XYZCT\""), 8).planes, ElementsAre(0, 1, 4, 5, 2, 3, 6, 7));
  EXPECT_THAT(layout(ome(sizes + "\"XYCZT\""), 8).planes, ElementsAre(0, 2, 4, 6, 1, 3, 5, 7));
  EXPECT_THAT(layout(ome(sizes + "\"XYTCZ\""), 8).planes, ElementsAre(0, 4, 1, 5, 2, 6, 3, 7));
  EXPECT_REFUSED(layout(ome(sizes + "\"XYZ\""), 8), HasSubstr("DimensionOrder"));
  EXPECT_REFUSED(layout(ome(sizes + "\"XYZCT\""), 7), HasSubstr("as the file has pages, 7"));
}

TEST(TiffLayout, OmeMayPlaceEachPlane) {
  const std::string two = "SizeZ=\"2\" SizeT=\"1\" SizeC=\"1\" DimensionOrder=\"XYZCT\"";
  const TiffLayout turned =
      layout(ome(two, "<TiffData IFD=\"1\" FirstZ=\"0\"/><TiffData IFD=\"0\" FirstZ=\"1\"/>"), 2);
  EXPECT_THAT(turned.planes, ElementsAre(1, 0));
  const TiffLayout other =
      layout(ome(two,
                 "<TiffData IFD=\"0\"><UUID FileName=\"a.tif\">u</UUID></TiffData>"
                 "<TiffData IFD=\"0\" FirstZ=\"1\"><UUID FileName=\"b.tif\">v</UUID></TiffData>"),
             1);
  EXPECT_THAT(other.planes, ElementsAre(0, -1));
  EXPECT_THAT(other.warnings, ElementsAre(HasSubstr("b.tif")));
  EXPECT_REFUSED(layout(ome(two, "<TiffData FirstZ=\"2\"/>"), 2), HasSubstr("FirstZ"));
}

TEST(TiffLayout, RefusesCountsThatTheFileCannotHold) {
  EXPECT_REFUSED(layout("ImageJ=1\nimages=6\nchannels=4\nslices=2\n", 6), HasSubstr("6"));
  EXPECT_REFUSED(layout("ImageJ=1\nimages=6\nchannels=-2\nslices=-3\n", 6), HasSubstr("channels"));
  EXPECT_REFUSED(layout("ImageJ=1\nchannels=4000000000\nslices=4000000000\nframes=4000000000\n", 6),
                 HasSubstr("channels"));
  EXPECT_REFUSED(layout(ome("SizeZ=\"2000000000\" SizeC=\"2000000000\" SizeT=\"2000000000\" "
                            "DimensionOrder=\"XYZCT\"",
                            "<TiffData/>"),
                        2),
                 HasSubstr("OME-XML"));
}

TEST(TiffLayout, AxesOfTifffileBeforeTheSlicesAreVolumes) {
  const TiffLayout found = layout("{\"shape\": [2, 3, 4, 5]}", 6);
  EXPECT_EQ(found.slices, 3);
  EXPECT_EQ(found.axes.volumes, 2);
  EXPECT_THAT(found.planes, ElementsAre(0, 1, 2, 3, 4, 5));
  EXPECT_EQ(layout("{\"shape\": [2, 3, 4, 5]}", 5).slices, 5) << "another number of pages";
}

TEST(TiffLayout, AxesOfTifffileHaveLetters) {
  const TiffLayout found = layout("{\"shape\": [3, 2, 4, 5], \"axes\": \"ZCYX\"}", 6);
  EXPECT_EQ(found.slices, 3);
  EXPECT_EQ(found.axes.volumes, 1);
  EXPECT_EQ(found.axes.channels, 2);
  EXPECT_THAT(found.planes, ElementsAre(0, 2, 4, 1, 3, 5));
  const TiffLayout times = layout("{\"shape\": [5, 1, 4, 5], \"axes\": \"TCYX\"}", 5);
  EXPECT_EQ(times.slices, 5);
  EXPECT_THAT(times.warnings, ElementsAre(HasSubstr("5 times of one slice each")));
  EXPECT_EQ(layout("{\"shape\": [3, 2, 4, 5], \"axes\": \"ZQYX\"}", 6).slices, 2)
      << "two axes of slices";
}

TEST(TiffLayout, TakesTheDistanceOfSlicesOfTifffile) {
  const std::string shape = "{\"shape\": [5, 3, 4], ";
  EXPECT_DOUBLE_EQ(layout(shape + "\"spacing\": 2.5, \"unit\": \"um\"}", 5).spacing.z, 0.0025);
  EXPECT_EQ(layout(shape + "\"spacing\": 2.5}", 5).between, 2.5);
  const TiffLayout odd = layout(shape + "\"unit\": \"pixel\", \"spacing\": 2.5}", 5);
  EXPECT_EQ(odd.spacing.z, 0);
  EXPECT_EQ(odd.between, 0);
  EXPECT_THAT(odd.warnings, ElementsAre(HasSubstr("\"pixel\" of the spacing is no length")));
  for (const char* text :
       {"\"spacing\": \"2\"}", "\"spacing\": nan}", "\"spacing\"", "\"unit\": \"um"}) {
    EXPECT_EQ(layout(shape + text, 5).spacing.z, 0) << text;
    EXPECT_EQ(layout(shape + text, 5).slices, 5) << text;
  }
}

}  // namespace
}  // namespace mesamis
