// SPDX-License-Identifier: Apache-2.0
#include "mesamis/files/dicom_subject.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/dicom_bytes.h"
#include "support/temp_folder.h"
#include "support/throws.h"

namespace mesamis {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Pair;

std::string file_of(const std::string& instance, const std::string& character_set = "ISO_IR 100") {
  DicomWriter set;
  set.text(0x00080005, "CS", character_set);
  set.text(0x00080016, "UI", "1.2.3");
  set.text(0x00080018, "UI", instance);
  set.text(0x00080020, "DA", "20200131");
  set.text(0x00100010, "PN", "M\xfcller^Eva");
  set.text(0x00100020, "LO", "42");
  set.text(0x0020000d, "UI", "1.2.5");
  set.text(0x0020000e, "UI", "1.2.8");
  set.text(0x00200052, "UI", "1.2.9");
  return SliceBytes::file(set.bytes(), DicomCoding::kExplicit);
}

TEST(DicomSubject, IsThatOfTheFirstFileAndHasAllSources) {
  const TempFolder folder;
  write_bytes(folder / "a.dcm", file_of("1.2.6"));
  write_bytes(folder / "b.dcm", file_of("1.2.7"));
  write_bytes(folder / "notes.txt", "no DICOM");
  const std::vector<ReadFile> files{
      {folder / "notes.txt", {}}, {folder / "a.dcm", {}}, {folder / "b.dcm", {}}};
  const DicomSubject subject = read_dicom_subject(files);
  EXPECT_EQ(subject.patient_name, "M\xc3\xbcller^Eva");
  EXPECT_EQ(subject.patient_id, "42");
  EXPECT_EQ(subject.birth_date, "");
  EXPECT_EQ(subject.study_uid, "1.2.5");
  EXPECT_EQ(subject.study_date, "20200131");
  EXPECT_EQ(subject.frame_of_reference, "1.2.9");
  EXPECT_EQ(subject.source_series, "1.2.8");
  EXPECT_THAT(subject.sources, ElementsAre(Pair("1.2.3", "1.2.6"), Pair("1.2.3", "1.2.7")));
  write_bytes(folder / "a.dcm", file_of("1.2.6", "ISO 2022 IR 87"));
  EXPECT_EQ(read_dicom_subject(files).patient_name, "M?ller^Eva");
}

TEST(DicomSubject, OfOtherFilesIsRefused) {
  const TempFolder folder;
  write_bytes(folder / "notes.txt", "no DICOM");
  const std::vector<ReadFile> files{{folder / "notes.txt", {}}};
  EXPECT_REFUSED(read_dicom_subject(files), HasSubstr("expected a file of a DICOM scan"));
  EXPECT_REFUSED(read_dicom_subject({}), HasSubstr("found none"));
  write_bytes(folder / "notes.txt", SliceBytes{}.bytes());
  EXPECT_REFUSED(read_dicom_subject(files), HasSubstr("Study Instance UID"));
}

}  // namespace
}  // namespace mesamis
