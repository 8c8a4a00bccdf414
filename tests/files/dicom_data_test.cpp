// SPDX-License-Identifier: Apache-2.0
#include "mesamis/files/dicom_data.h"

#include <gmock/gmock.h>

#include "support/bytes_span.h"
#include "support/dicom_bytes.h"
#include "support/temp_folder.h"
#include "support/throws.h"
#include "support/wide_budget.h"

namespace mesamis {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Optional;

DicomFile parsed(const std::string& bytes) {
  const TempFolder folder;
  write_bytes(folder / "a.dcm", bytes);
  WideBudget budget;
  return read_dicom_file(folder / "a.dcm", budget);
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
  WideBudget budget;
  EXPECT_REFUSED(read_dicom_file("/nowhere/a.dcm", budget), HasSubstr("/nowhere/a.dcm"));
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

/// Lengths of 4 GiB, undefined lengths where there may be none, and VRs that the standard does not
/// know, in the meta group and behind it: none is believed.
TEST(DicomData, ClaimsOfLengthTakeNoMemory) {
  const TempFolder folder;
  const std::string start = std::string(128, '\0') + "DICM";
  for (const std::string vr : {"OB", "UN", "UT", "ZZ", "??", "SQ", "QQ"}) {
    for (const std::uint32_t length : {0xffffffffu, 0xfffffffeu, 0x7fffffffu, 0x10000u}) {
      for (const std::string& tag : {std::string("\2\0\2\1", 4), std::string("\x10\0\x10\0", 4)}) {
        const std::string element = tag + vr + std::string(2, '\0') + bytes_of(length);
        write_bytes(folder / "a.dcm", start + element + std::string(100, '\1'));
        MemoryBudget budget("a.dcm", {1e-5});
        EXPECT_NE(read_dicom_file(folder / "a.dcm", budget).problem, "") << vr << length;
      }
    }
  }
}

/// 40 MB of zeros in 40 kB, and items of eight bytes that each become a map.
TEST(DicomData, DeflatedDataAndItemsAreClaimedBeforeTheyAreMade) {
  const TempFolder folder;
  const auto file = [&folder](const std::string& set) {
    write_bytes(folder / "a.dcm", SliceBytes::file(set, DicomCoding::kDeflated));
    return folder / "a.dcm";
  };
  const auto refused = [](const std::filesystem::path& path, double memory_gb) {
    MemoryBudget budget(path, {memory_gb});
    EXPECT_REFUSED(read_dicom_file(path, budget), HasSubstr("a.dcm: memory: expected"));
  };
  refused(file(std::string(40'000'000, '\0')), 0.03);
  DicomWriter set;
  set.sequence(0x00081140, std::vector<std::string>(200'000), true);
  refused(file(set.bytes()), 0.015);
  std::string elements;
  for (int n = 0; n < 60'000; ++n) {
    elements += bytes_of(std::uint16_t{9}) + bytes_of(static_cast<std::uint16_t>(n)) + "LO" +
                std::string(2, '\0');
  }
  refused(file(elements), 0.005);
  MemoryBudget enough("a.dcm", {0.1});
  EXPECT_EQ(read_dicom_file(file(elements), enough).elements.size(), 60'000u);
}

}  // namespace
}  // namespace mesamis
