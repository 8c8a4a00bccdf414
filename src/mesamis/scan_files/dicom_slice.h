// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "mesamis/base/types.h"
#include "mesamis/scan_files/dicom_data.h"

namespace mesamis::detail {

/// One frame: where its samples are and where it lies in space. LPS, mm.
struct DicomSlice {
  std::filesystem::path file;
  int frame = 0;  ///< 0 for a file of one image
  int columns = 0, rows = 0;
  Vec3 along_row, along_column;  ///< directions in which the column and row numbers grow
  Vec3 position;                 ///< centre of the first pixel
  double column_step = 1, row_step = 1;
  double slope = 1, intercept = 0;
  bool localizer = false;  ///< its Image Type says LOCALIZER
};

/// The slices of one file and the series they belong to.
struct DicomImage {
  std::filesystem::path file;
  std::string series, description, modality;
  bool has_pixels = false;         ///< false: a report, a plan, a structure set
  std::vector<DicomSlice> slices;  ///< empty if there is a problem
  std::string problem;             ///< the whole line; empty: none
  std::string warning;
};

/// Reads everything but the samples. `problem` describes content that cannot be used; nothing is
/// thrown for it.
DicomImage describe_image(const DicomFile& file);

/// "IM0001.dcm", "IM0001.dcm frame 3": how messages name a slice.
std::string name_of(const DicomSlice& slice);

}  // namespace mesamis::detail
