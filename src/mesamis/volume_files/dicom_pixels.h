// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "mesamis/files/dicom_data.h"

/// The pixels of a DICOM file: how they are coded, and their values.
namespace mesamis::detail::volume_files {

/// How the pixels of a file are coded.
struct DicomPixels {
  int columns = 0, rows = 0, frames = 1;
  int bits_allocated = 16, bits_stored = 16, high_bit = 15;
  bool is_signed = false;
};

/// Which pixels a reader accepts.
enum class PixelUse {
  kGrey,    ///< grey values of 8, 16 or 32 bits
  kLabels,  ///< also single bits, packed without gaps over all frames, and indices of a palette
};

/// The coding of the pixels, checked against what can be decoded and the bytes that are there.
/// @throws InputError  for pixels that are missing, not grey, not whole-numbered or not rescaled
///                     linearly, for an unknown transfer syntax, and for fewer bytes than the
///                     header claims.
DicomPixels pixels_of(const DicomFile& file, PixelUse use = PixelUse::kGrey);

/// What the decoding of a frame takes beside its samples: compressed and decoded words, and the
/// decoder's own memory as far as the picture's header decides it.
/// @param frame  from 0.
/// @return bytes; 0 for native pixels. O(compressed bytes of the frame).
/// @throws InputError  if the frame has no data, or its picture is not the file's or cut off.
std::uint64_t decoding_bytes(const DicomFile& file, const DicomPixels& pixels, int frame);

/// One frame of a file, from 0, and its rescale: native value = slope * stored + intercept.
struct FrameRescale {
  int frame = 0;
  double slope = 1, intercept = 0;
};

/// Appends the native values of one frame, row by row.
///
/// Memory: one frame more than the output.
/// @return whether the data were intact. A damaged JPEG is decoded as far as its data go.
/// @throws InputError  if the compressed data cannot be decoded.
bool append_frame(const DicomFile& file, const DicomPixels& pixels, const FrameRescale& rescale,
                  std::vector<float>& out);

}  // namespace mesamis::detail::volume_files
