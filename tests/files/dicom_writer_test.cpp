// SPDX-License-Identifier: Apache-2.0
#include "mesamis/files/dicom_writer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/wide_budget.h"

namespace mesamis {
namespace {

using testing::HasSubstr;
using testing::SizeIs;
using testing::StartsWith;

TEST(DicomWriter, WritesWhatTheParserReads) {
  DicomSetWriter set;
  set.set(0x00420011, "OB", std::string(70'001, 'x'));  // longer than 16 bits, odd
  set.set_number(0x00280010, "US", 513);
  set.set_number(0x00420015, "UL", 0x01020304);
  set.set(dicom::kSopClass, "UI", "1.2.3");
  set.set_items(0x0040a043, {});
  set.set_items(dicom::kSegments, {dicom_code({"mm", "UCUM", "millimetre"}), DicomSetWriter{}});
  WideBudget budget;
  const DicomFile file = parse_dicom("f", dicom_file_bytes(set, {"1.2.3", "1.2.4"}), budget);
  EXPECT_EQ(file.problem, "");
  EXPECT_EQ(file.transfer_syntax, "1.2.840.10008.1.2.1");
  EXPECT_EQ(text_of(file.elements, dicom::kSopClass), "1.2.3");
  EXPECT_EQ(number_of(file, file.elements, dicom::kRows), 513);
  EXPECT_THAT(file.elements.at(0x00420011).value, SizeIs(70'002));
  EXPECT_EQ(file.elements.at(0x00420015).value[0], 4);
  EXPECT_THAT(file.elements.at(0x0040a043).items, SizeIs(0));
  ASSERT_THAT(file.elements.at(dicom::kSegments).items, SizeIs(2));
  EXPECT_EQ(text_of(file.elements.at(dicom::kSegments).items[0], 0x00080104), "millimetre");
}

TEST(DicomWriter, UidsAreThoseOfTheirText) {
  EXPECT_EQ(dicom_uid_of("a"), dicom_uid_of("a"));
  EXPECT_NE(dicom_uid_of("a"), dicom_uid_of("b"));
  for (const std::string text : {"", "a", "b", "a longer one"}) {
    const std::string uid = dicom_uid_of(text);
    EXPECT_THAT(uid, StartsWith("2.25."));
    EXPECT_NE(uid[5], '0');
    EXPECT_LE(uid.size(), 64u);
    EXPECT_EQ(uid.find_first_not_of("0123456789."), std::string::npos);
  }
}

}  // namespace
}  // namespace mesamis
