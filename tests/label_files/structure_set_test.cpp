// SPDX-License-Identifier: Apache-2.0
#include "mesamis/label_files/structure_set.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/contour_bytes.h"
#include "support/temp_folder.h"
#include "support/throws.h"
#include "support/wide_budget.h"

namespace mesamis {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::SizeIs;

DicomFile dicom_of(const StructureBytes& bytes) {
  const TempFolder folder;
  WideBudget budget;
  write_bytes(folder / "a.dcm", bytes.bytes());
  return read_dicom_file(folder / "a.dcm", budget);
}

StructureSet read(const StructureBytes& bytes) {
  WideBudget budget;
  return read_structure_set(dicom_of(bytes), budget);
}

TEST(StructureSet, HasRegionsWithNamesColoursAndContours) {
  for (const DicomCoding coding : {DicomCoding::kExplicit, DicomCoding::kImplicit,
                                   DicomCoding::kBigEndian, DicomCoding::kDeflated}) {
    for (const bool open : {false, true}) {
      StructureBytes bytes = small_structure_set();
      bytes.coding = coding;
      bytes.open = open;
      bytes.regions.push_back({7, "skin", "", "", {rectangle_contour({0, 0, 1}, 2, 3)}});
      EXPECT_TRUE(is_structure_set(dicom_of(bytes)));
      const StructureSet set = read(bytes);
      ASSERT_THAT(set.regions, SizeIs(2));
      EXPECT_EQ(set.regions[0].name, "bone");
      EXPECT_THAT(set.regions[0].colour, ElementsAre(255, 128, 0));
      ASSERT_THAT(set.regions[0].contours, SizeIs(3));
      EXPECT_THAT(set.regions[0].contours[2].points, SizeIs(64));
      EXPECT_EQ(set.regions[1].number, 7);
      EXPECT_EQ(set.regions[1].frame, "1.2.9");  // of the whole set
      EXPECT_THAT(set.regions[1].contours[0].points,
                  ElementsAre(Vec3{0, 0, 1}, Vec3{2, 0, 1}, Vec3{2, 3, 1}, Vec3{0, 3, 1}));
      EXPECT_THAT(set.warnings, SizeIs(0));
    }
  }
}

TEST(StructureSet, ContoursLongerThanOtherTextsAreRead) {
  StructureBytes bytes = small_structure_set();
  bytes.coding = DicomCoding::kImplicit;  // explicit lengths of decimals have 16 bits
  RegionContour& contour = bytes.regions[0].contours[0];
  contour.points.resize(20'000, {1.25, 2.5, 3});
  EXPECT_THAT(read(bytes).regions[0].contours[0].points, SizeIs(20'000));
}

TEST(StructureSet, WhatHasNoInsideIsLeftOutWithAWarning) {
  StructureBytes bytes = small_structure_set();
  bytes.regions[0].contours.push_back({{{1, 2, 3}}, "POINT"});
  bytes.regions[0].contours.push_back({{{1, 2, 3}, {4, 5, 3}}, "CLOSED_PLANAR"});
  bytes.regions.push_back({2, "isocentre", "", "", {{{{1, 2, 3}}, "POINT"}}});
  const StructureSet set = read(bytes);
  ASSERT_THAT(set.regions, SizeIs(1));
  EXPECT_THAT(set.regions[0].contours, SizeIs(3));
  EXPECT_THAT(set.warnings,
              ElementsAre(HasSubstr("2 contours of the type \"POINT\" left out"),
                          HasSubstr("1 closed contours of fewer than 3 points"),
                          HasSubstr("the region \"isocentre\" has no contour with an inside")));
}

TEST(StructureSet, NumbersThatAreNoLabelsAreReplaced) {
  StructureBytes bytes = small_structure_set();
  bytes.regions.push_back(bytes.regions[0]);
  bytes.regions[0].number = 0;
  bytes.regions[1].number = 70000;
  const StructureSet set = read(bytes);
  EXPECT_EQ(set.regions[0].number, 1);
  EXPECT_EQ(set.regions[1].number, 2);
}

TEST(StructureSet, BrokenOnesAreRefused) {
  const StructureBytes well = small_structure_set();
  const auto refused = [](const StructureBytes& bytes, const std::string& why) {
    EXPECT_REFUSED(read(bytes), HasSubstr(why));
  };
  StructureBytes bytes = well;
  for (const char* data : {"1\\2\\3\\4", "1\\2\\x", "1\\2\\", "nan\\2\\3", "1e9\\2\\3"}) {
    bytes.regions[0].contours[1].data = data;
    refused(bytes, "as Contour Data (3006,0050) of the region \"bone\", found");
  }
  bytes = well;
  bytes.regions.push_back(bytes.regions[0]);
  refused(bytes, "each ROI Number once, found 1 again");
  bytes = well;
  bytes.regions[0].contours.resize(0);
  refused(bytes, "expected regions with closed planar contours, found 1 regions without any");
  bytes.regions.clear();
  refused(bytes, "found 0 regions");
}

}  // namespace
}  // namespace mesamis
