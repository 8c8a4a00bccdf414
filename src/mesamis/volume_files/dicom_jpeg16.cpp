// SPDX-License-Identifier: Apache-2.0
#include <cstddef>
#include <cstdio>
extern "C" {
#include <gdcmjpeg/16/jpeglib.h>
}
#include "mesamis/volume_files/dicom_jpeg_decoder.h"

namespace mesamis::detail::volume_files {

std::optional<JpegSamples> decode_jpeg16(Bytes picture, const PictureHeader& header) {
  return JpegDecoder<16>(picture, header).decode();
}

}  // namespace mesamis::detail::volume_files
