// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mesamis/volume_files/dicom_pixels.h"

namespace mesamis::detail::volume_files {

/// Decodes one frame of JPEG-LS or JPEG 2000 pixels by GDCM.
///
/// GDCM reports broken data by gdcm::Trace, which prints to std::cerr by default and has no setting
/// per image. It is off while any thread decodes; then its flags are as they were.
/// @param transfer_syntax  its UID, as the file states it.
/// @param pixels           size and bits of the picture, checked against its own header.
/// @return words of bits_allocated bits, little endian, row by row; none if it cannot be decoded.
std::optional<std::vector<unsigned char>> decode_by_gdcm(Bytes picture,
                                                         const std::string& transfer_syntax,
                                                         const DicomPixels& pixels);

}  // namespace mesamis::detail::volume_files
