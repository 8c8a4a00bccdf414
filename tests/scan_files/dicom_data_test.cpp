// SPDX-License-Identifier: Apache-2.0
#include "mesamis/scan_files/dicom_data.h"

#include <gmock/gmock.h>

#include "support/bytes_span.h"
#include "support/dicom_bytes.h"
#include "support/temp_folder.h"
#include "support/throws.h"

namespace mesamis::detail {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Optional;

DicomFile parsed(const std::string& bytes) {
  const TempFolder folder;
  write_bytes(folder / "a.dcm", bytes);
  return read_dicom_file(folder / "a.dcm");
}

std::string small_set(DicomCoding coding) {
  DicomWriter item(coding), set(coding);
  item.decimals(dicom::kSlope, {2.5});
  set.text(dicom::kModality, "CS", "CT");
  set.number(dicom::kRows, 513);
  set.decimals(dicom::kPixelSpacing, {0.5, 0.25});
  set.sequence(dicom::kSharedGroups, {item.bytes()}, true);
  return SliceBytes::file(set.bytes(), coding);
}

TEST(DicomData, ReadsTheSameElementsInEveryCoding) {
  for (const DicomCoding coding :
       {DicomCoding::kExplicit, DicomCoding::kImplicit, DicomCoding::kBigEndian,
        DicomCoding::kDeflated, DicomCoding::kWithoutMeta}) {
    const DicomFile file = parsed(small_set(coding));
    EXPECT_EQ(file.problem, "");
    EXPECT_EQ(file.big_endian, coding == DicomCoding::kBigEndian);
    EXPECT_EQ(text_of(file.elements, dicom::kModality), "CT");
    EXPECT_THAT(number_of(file, file.elements, dicom::kRows), Optional(513));
    EXPECT_THAT(decimals_of(file.elements, dicom::kPixelSpacing, 2),
                Optional(ElementsAre(0.5, 0.25)));
    const DicomSet* item = first_item(file.elements, dicom::kSharedGroups);
    ASSERT_NE(item, nullptr);
    EXPECT_THAT(decimals_of(*item, dicom::kSlope, 1), Optional(ElementsAre(2.5)));
  }
}

TEST(DicomData, ElementsThatAreAbsentOrNoNumbersGiveNone) {
  DicomWriter set;
  set.text(dicom::kSlope, "DS", "1\\two");
  const DicomFile file = parsed(SliceBytes::file(set.bytes(), DicomCoding::kExplicit));
  EXPECT_EQ(text_of(file.elements, dicom::kModality), "");
  EXPECT_EQ(number_of(file, file.elements, dicom::kRows), std::nullopt);
  EXPECT_EQ(decimals_of(file.elements, dicom::kSlope, 2), std::nullopt);
  EXPECT_EQ(decimals_of(file.elements, dicom::kPixelSpacing, 2), std::nullopt);
  EXPECT_EQ(first_item(file.elements, dicom::kSharedGroups), nullptr);
}

TEST(DicomData, DecimalsMustBeAsManyAsExpected) {
  const DicomFile file = parsed(small_set(DicomCoding::kExplicit));
  EXPECT_EQ(decimals_of(file.elements, dicom::kPixelSpacing, 1), std::nullopt);
  EXPECT_EQ(decimals_of(file.elements, dicom::kPixelSpacing, 3), std::nullopt);
}

/// Every cut through a file is a problem or a shorter file, and never a crash.
TEST(DicomData, ACutKeepsWhatWasReadBefore) {
  const std::string whole = small_set(DicomCoding::kExplicit);
  for (std::size_t size = 0; size <= whole.size(); ++size) {
    const DicomFile file = parsed(whole.substr(0, size));
    const std::string modality = text_of(file.elements, dicom::kModality);
    EXPECT_TRUE(modality.empty() || modality == "CT") << size;
  }
  const DicomFile cut = parsed(whole.substr(0, whole.size() - 20));
  EXPECT_NE(cut.problem, "");
  EXPECT_EQ(text_of(cut.elements, dicom::kModality), "CT");
}

TEST(DicomData, ALengthBeyondTheFileIsAProblem) {
  DicomWriter set;
  set.text(dicom::kModality, "CS", "CT");
  std::string bytes = SliceBytes::file(set.bytes(), DicomCoding::kExplicit);
  bytes[bytes.size() - 4] = '\x7f';
  EXPECT_THAT(parsed(bytes).problem, HasSubstr("claims 127 bytes"));
}

TEST(DicomData, ThePreambleOrAnEarlyGroupShowsDicom) {
  EXPECT_TRUE(begins_like_dicom(bytes_in(small_set(DicomCoding::kExplicit))));
  EXPECT_TRUE(begins_like_dicom(bytes_in(small_set(DicomCoding::kWithoutMeta))));
  EXPECT_FALSE(begins_like_dicom(bytes_in("not DICOM at all")));
  EXPECT_FALSE(begins_like_dicom({}));
}

TEST(DicomData, AFileThatIsNotThereIsRefused) {
  EXPECT_REFUSED(read_dicom_file("/nowhere/a.dcm"), HasSubstr("/nowhere/a.dcm"));
}

TEST(DicomData, ReadsSeveralNumbersInBothByteOrders) {
  for (const bool big_endian : {false, true}) {
    const std::string bytes = bytes_of_all(std::vector<std::uint16_t>{1, 300, 65535}, big_endian);
    DicomFile file;
    file.big_endian = big_endian;
    file.elements[dicom::kCieLab].value = bytes_in(bytes);
    EXPECT_THAT(numbers_of(file, file.elements, dicom::kCieLab, 3),
                Optional(ElementsAre(1, 300, 65535)));
    EXPECT_EQ(numbers_of(file, file.elements, dicom::kCieLab, 4), std::nullopt);
    EXPECT_EQ(number_of(file, file.elements, dicom::kCieLab), 1);
    EXPECT_EQ(numbers_of(file, file.elements, dicom::kRows, 1), std::nullopt);
  }
}

}  // namespace
}  // namespace mesamis::detail
