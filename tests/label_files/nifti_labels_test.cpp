// SPDX-License-Identifier: Apache-2.0
#include "mesamis/label_files/nifti_labels.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "mesamis/volume_files/formats.h"
#include "support/expect_near.h"
#include "support/temp_folder.h"
#include "support/throws.h"
#include "support/wide_budget.h"

namespace mesamis {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

std::vector<Segment> segments_of(const std::filesystem::path& file,
                                 const std::vector<std::string>& extensions) {
  WideBudget budget;
  return segments_in_extensions(file, extensions, budget);
}

// As TotalSegmentator writes it, with NUL characters behind.
const std::string kCaret =
    "<?xml version=\"1.0\" encoding=\"UTF-8\"?> <CaretExtension>  <Date><![CDATA[2013]]></Date>\n"
    "<VolumeInformation Index=\"0\">   <LabelTable>\n"
    "<Label Key=\"0\" Red=\"1\" Green=\"1\" Blue=\"1\" Alpha=\"0\"><![CDATA[???]]></Label>\n"
    "<Label Key=\"1\" Red=\"0.0\" Green=\"1.0\" Blue=\"0.5019607843137255\" Alpha=\"1\">"
    "<![CDATA[spleen]]></Label>\n<Label Key=\"92\"><![CDATA[rib & co]]></Label>\n"
    "<Label Key=\"92\"><![CDATA[again]]></Label>\n<Label Key=\"93\"></Label>\n"
    "</LabelTable>  </VolumeInformation></CaretExtension>" +
    std::string(7, '\0');

TEST(NiftiLabels, AreThoseOfTheCaretExtension) {
  const std::vector<Segment> expected{{"spleen", 1, 0, {0, 255, 128}},
                                      {"rib & co", 92, 0, default_colour(92)}};
  EXPECT_EQ(segments_of("f", {"AFNI or other", kCaret}), expected);
  EXPECT_THAT(segments_of("f", {"AFNI or other"}), IsEmpty());
  EXPECT_THAT(segments_of("f", {}), IsEmpty());
}

TEST(NiftiLabels, BrokenOnesAreRefused) {
  EXPECT_REFUSED(segments_of("f", {kCaret.substr(0, 300)}), HasSubstr("f: "));
  EXPECT_REFUSED(segments_of("f", {"<CaretExtension><Label Key=\"-1\">a</Label></CaretExtension>"}),
                 HasSubstr("label's Key in the header extension, found \"-1\""));
  EXPECT_EQ(
      segments_of("f", {"<CaretExtension><Label Key=\"70000\">a</Label></CaretExtension>"})[0],
      (Segment{"a", 0, 0, default_colour(0), 70000}));
}

TEST(NiftiLabels, ExtensionReadsBack) {
  const std::vector<Segment> segments{{"a < b & \"c\"", 1, 0, {1, 2, 3}},
                                      {"Hüfte", 65535, 0, {255, 254, 0}}};
  EXPECT_EQ(segments_of("f", {caret_extension(segments)}), segments);
  EXPECT_THAT(segments_of("f", {caret_extension({})}), IsEmpty());
}

VoxelGrid turned_grid(double angle, bool left_handed) {
  const double c = std::cos(angle), s = std::sin(angle), e = left_handed ? -1 : 1;
  VoxelGrid grid;
  grid.size = {2, 3, 4};
  grid.spacing = {0.75, 1.25, 2};
  grid.origin = {-31, 14.5, 105.25};
  grid.direction =
      Mat3{{Vec3{c, -s * c, e * s * s}, Vec3{s, c * c, -e * c * s}, Vec3{0, s, e * c}}};
  return grid;
}

/// With the code of the sform set to 0 the qform must place the voxels at the same points.
TEST(NiftiLabels, BothFormsPlaceTheGrid) {
  const TempFolder folder;
  WideBudget budget;
  for (const double angle : {0.0, 0.3, 1.6, 3.1415926535897931, -2.5}) {
    for (const bool left_handed : {false, true}) {
      const VoxelGrid grid = turned_grid(angle, left_handed);
      for (const bool with_sform : {true, false}) {
        std::string header = nifti_header(grid, 1, "<CaretExtension/>");
        header.replace(254, 1, 1, with_sform ? '\1' : '\0');
        write_bytes(folder / "a.nii", header + std::string(24, '\0'));
        const ScanFile scan = open_nifti(folder / "a.nii", {budget});
        EXPECT_THAT(scan.warnings, IsEmpty());
        EXPECT_THAT(scan.grid.size, ElementsAre(2, 3, 4));
        for (const Vec3& p : {Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}) {
          expect_near(scan.grid.to_world(p), grid.to_world(p), 1e-5);
        }
      }
    }
  }
  EXPECT_THAT(nifti_extensions(folder / "a.nii", budget),
              ElementsAre(HasSubstr("<CaretExtension/>")));
}

}  // namespace
}  // namespace mesamis
