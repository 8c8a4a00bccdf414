// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "mesamis/files/dicom_data.h"

namespace mesamis::detail::volume_files {

/// Decodes one frame of RLE pixels: PS3.5 annex G, one segment of PackBits per byte of the pixel,
/// the most significant first.
///
/// @param file    names the file in messages.
/// @param packed  a header of 64 bytes, then the segments.
/// @param pixels  number of pixels.
/// @param width   bytes per pixel, 1 to 4.
/// @return pixels * width bytes, little endian.
/// @throws InputError  for another number of segments, or one that ends early or runs over.
std::vector<unsigned char> decode_rle(const std::filesystem::path& file, Bytes packed,
                                      std::size_t pixels, std::size_t width);

}  // namespace mesamis::detail::volume_files
