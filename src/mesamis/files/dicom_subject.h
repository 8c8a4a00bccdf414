// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <utility>
#include <vector>

#include "mesamis/files/reading.h"

namespace mesamis {

/// The patient and the study that a DICOM file belongs to. Texts are UTF-8, as DICOM writes them:
/// "Doe^Jane", "19700101"; empty: not known.
struct DicomSubject {
  std::string patient_name, patient_id, birth_date, sex;
  std::string study_uid, study_date, study_time, study_id, accession_number, referring_physician;
  std::string frame_of_reference;  ///< UID of the frame in which coordinates are LPS, mm
  /// UID of the source series, and SOP class and instance UIDs of its files.
  std::string source_series{};
  std::vector<std::pair<std::string, std::string>> sources{};
};

/// Reads them from the files of a DICOM scan: patient, study and frame of reference of the first
/// one, and the UIDs of all.
/// @param files  as VolumeFile::files; those that are no DICOM are skipped.
/// @throws InputError  if no file is DICOM or the first one states no study, naming it.
///
/// O(bytes). Memory: one file at a time.
DicomSubject read_dicom_subject(std::span<const ReadFile> files, const ReadLimits& limits = {});

}  // namespace mesamis
