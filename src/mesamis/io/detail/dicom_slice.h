// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "mesamis/base/types.h"
#include "mesamis/io/detail/dicom_data.h"

namespace mesamis::detail {

/// How the pixels of a file are coded.
struct DicomPixels {
  int columns = 0, rows = 0, frames = 1;
  int bits_allocated = 16, bits_stored = 16, high_bit = 15;
  bool is_signed = false;
};

/// One frame: where its samples are and where it lies in space. LPS, mm.
struct DicomSlice {
  std::filesystem::path file;
  int frame = 0;  ///< 0 for a file of one image
  int columns = 0, rows = 0;
  Vec3 along_row, along_column;  ///< directions in which the column and row numbers grow
  Vec3 position;                 ///< centre of the first pixel
  double column_step = 1, row_step = 1;
  double slope = 1, intercept = 0;
  bool localizer = false;  ///< the file calls itself one
};

/// What one file brings.
struct DicomImage {
  std::filesystem::path file;
  std::string series, description, modality;
  bool has_pixels = false;         ///< false: a report, a plan, a structure set
  std::vector<DicomSlice> slices;  ///< empty if there is a problem
  std::string problem;             ///< the whole line; empty: none
  std::string warning;
};

/// Looks at everything but the pixels themselves. Never throws for what the file holds.
DicomImage describe_image(const DicomFile& file);

/// The pixels' coding, checked against what this room can decode and the bytes that are there.
/// @throws InputError
DicomPixels pixels_of(const DicomFile& file);

/// Appends one frame as native values, slope * stored + intercept, row by row.
/// @throws InputError  if the compressed data are broken.
void append_frame(const DicomFile& file, const DicomPixels& pixels, const DicomSlice& slice,
                  std::vector<float>& out);

}  // namespace mesamis::detail
