// SPDX-License-Identifier: Apache-2.0
#include <cstddef>
#include <cstdio>
extern "C" {
#include <gdcmjpeg/12/jpeglib.h>
}
#include "mesamis/volume_files/dicom_jpeg_decoder.h"

namespace mesamis::detail::volume_files {

std::optional<JpegSamples> decode_jpeg12(Bytes picture, const PictureHeader& header) {
  return JpegDecoder<12>(picture, header).decode();
}

}  // namespace mesamis::detail::volume_files
