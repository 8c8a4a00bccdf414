// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "mesamis/files/dicom_data.h"

/// Compressed pictures inside DICOM files: what their headers state, and JPEG's samples.
namespace mesamis::detail::volume_files {

/// What a compressed picture states about itself. It is read before any decoder sees the data.
struct PictureHeader {
  int columns = 0, rows = 0, components = 0;
  int bits = 0;  ///< precision of a sample
};

/// The start-of-frame segment of JPEG or JPEG-LS; none if there is none.
std::optional<PictureHeader> jpeg_header(Bytes picture);

/// The SIZ segment of a JPEG 2000 codestream; none if it does not come first.
std::optional<PictureHeader> jpeg2000_header(Bytes picture);

/// An upper bound of what a decoder of JPEG 2000 takes for the structure that a codestream states:
/// tiles, resolutions, layers, precincts and code blocks, of which a header of some bytes can claim
/// millions. Read from all COD and COC segments (ISO/IEC 15444-1, A.6.1 and A.6.2).
/// @param picture  begins with a SIZ segment, see jpeg2000_header().
/// @param pixels   of the picture.
/// @return bytes; the largest number of 64 bits where the segments cannot be followed.
std::uint64_t jpeg2000_structure_bytes(Bytes picture, std::uint64_t pixels);

/// Whether JPEG's EOI or JPEG 2000's EOC marker ends the data; up to 16 bytes of padding may
/// follow. Decoders fill up what is cut off and report success.
bool has_end_marker(Bytes picture);

/// Samples as they are coded, row by row.
struct JpegSamples {
  std::vector<std::uint16_t> values;
  bool intact = true;  ///< false: the decoder met corrupt data and went on
};

/// Decodes a grey JPEG picture (ISO 10918-1: baseline, extended, progressive, lossless).
///
/// The decoders are the Independent JPEG Group's for 8, 12 and 16 bits, which GDCM brings. They
/// are called directly and not through GDCM's classes, because those print to stderr.
/// @param picture  from SOI to EOI.
/// @param header   jpeg_header(picture): one component, 2 to 16 bits.
/// @return columns * rows samples; none if the picture cannot be decoded.
std::optional<JpegSamples> decode_jpeg(Bytes picture, const PictureHeader& header);

/// decode_jpeg() for each precision: up to 8, 12 and 16 bits.
std::optional<JpegSamples> decode_jpeg8(Bytes picture, const PictureHeader& header);
std::optional<JpegSamples> decode_jpeg12(Bytes picture, const PictureHeader& header);
std::optional<JpegSamples> decode_jpeg16(Bytes picture, const PictureHeader& header);

}  // namespace mesamis::detail::volume_files
