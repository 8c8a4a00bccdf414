// SPDX-License-Identifier: Apache-2.0
#include "mesamis/files/dicom_subject.h"

#include <array>

#include "mesamis/base/error.h"
#include "mesamis/base/utf8.h"
#include "mesamis/files/byte_source.h"
#include "mesamis/files/dicom_text.h"
#include "mesamis/files/refuse.h"

namespace mesamis {
namespace {

namespace fs = std::filesystem;

struct Place {
  std::string DicomSubject::*field;
  DicomTag tag;
};

constexpr DicomTag kStudyUid = 0x0020000d;

constexpr std::array<Place, 12> kPlaces{
    {{&DicomSubject::patient_name, 0x00100010},
     {&DicomSubject::patient_id, 0x00100020},
     {&DicomSubject::birth_date, 0x00100030},
     {&DicomSubject::sex, 0x00100040},
     {&DicomSubject::study_uid, kStudyUid},
     {&DicomSubject::study_date, 0x00080020},
     {&DicomSubject::study_time, 0x00080030},
     {&DicomSubject::study_id, 0x00200010},
     {&DicomSubject::accession_number, 0x00080050},
     {&DicomSubject::referring_physician, 0x00080090},
     {&DicomSubject::frame_of_reference, dicom::kFrameOfReference},
     {&DicomSubject::source_series, dicom::kSeriesUid}}};

bool is_dicom(const fs::path& file) {
  std::array<unsigned char, 132> begin{};
  const std::size_t got = ByteSource(file, Packing::kPlain).read(begin.data(), begin.size());
  return begins_like_dicom(Bytes(begin).first(got));
}

/// Other character sets than Latin-1 and UTF-8 are not converted: their texts keep what is ASCII.
std::string text_in(const DicomFile& file, DicomTag tag) {
  const std::string text = utf8_text(file, file.elements, tag);
  return is_utf8(text) ? text : shown(text);
}

void take_subject(const DicomFile& file, DicomSubject& subject) {
  for (const auto& [field, tag] : kPlaces) subject.*field = text_in(file, tag);
  if (subject.study_uid.empty()) {
    refuse(file.path, "expected a Study Instance UID (0020,000d), found none");
  }
}

}  // namespace

DicomSubject read_dicom_subject(std::span<const ReadFile> files, const ReadLimits& limits) {
  DicomSubject subject;
  if (files.empty()) throw InputError("patient: expected a DICOM scan, found none");
  MemoryBudget budget(files.front().path, limits);
  for (const auto& [path, state] : files) {
    if (!is_dicom(path)) continue;
    const ScopedFile scope(budget, path);
    const DicomFile file = read_dicom_file(path, budget);
    if (subject.study_uid.empty()) take_subject(file, subject);
    subject.sources.emplace_back(text_of(file.elements, dicom::kSopClass),
                                 text_of(file.elements, dicom::kSopInstance));
  }
  if (subject.study_uid.empty()) {
    refuse(files.front().path, "expected a file of a DICOM scan, found another one");
  }
  return subject;
}

}  // namespace mesamis
