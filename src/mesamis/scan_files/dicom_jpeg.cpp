// SPDX-License-Identifier: Apache-2.0
#include "mesamis/scan_files/dicom_jpeg.h"

#include <algorithm>
#include <array>

namespace mesamis::detail {
namespace {

int big16(Bytes b, std::size_t at) { return b[at] << 8 | b[at + 1]; }

}  // namespace

std::optional<PictureHeader> jpeg_header(Bytes b) {
  for (std::size_t at = 2; at + 10 <= b.size() && b[at] == 0xff;) {
    const int marker = b[at + 1];
    if (marker == 0xff) {  // fill byte
      ++at;
      continue;
    }
    const bool frame = marker == 0xf7 || (marker >= 0xc0 && marker <= 0xcf && marker != 0xc4 &&
                                          marker != 0xc8 && marker != 0xcc);
    if (frame) return PictureHeader{big16(b, at + 7), big16(b, at + 5), b[at + 9], b[at + 4]};
    at += 2 + static_cast<std::size_t>(big16(b, at + 2));
  }
  return std::nullopt;
}

std::optional<PictureHeader> jpeg2000_header(Bytes b) {
  if (b.size() < 43 || big16(b, 0) != 0xff4f || big16(b, 2) != 0xff51) return std::nullopt;
  const auto big32 = [b](std::size_t at) {
    return static_cast<std::int64_t>(big16(b, at)) << 16 | big16(b, at + 2);
  };
  const std::int64_t columns = big32(8) - big32(16), rows = big32(12) - big32(20);
  if (columns < 1 || rows < 1 || columns > 65535 || rows > 65535) return std::nullopt;
  return PictureHeader{static_cast<int>(columns), static_cast<int>(rows), big16(b, 40),
                       (b[42] & 0x7f) + 1};
}

bool has_end_marker(Bytes picture) {
  constexpr std::size_t kMostPadding = 16;
  const Bytes end = picture.last(std::min(picture.size(), kMostPadding + 2));
  constexpr std::array<unsigned char, 2> kMarker{0xff, 0xd9};
  return std::search(end.begin(), end.end(), kMarker.begin(), kMarker.end()) != end.end();
}

std::optional<JpegSamples> decode_jpeg(Bytes picture, const PictureHeader& header) {
  if (header.components != 1 || header.columns < 1 || header.rows < 1) return std::nullopt;
  if (header.bits < 2 || header.bits > 16) return std::nullopt;
  if (header.bits <= 8) return decode_jpeg8(picture, header);
  return header.bits <= 12 ? decode_jpeg12(picture, header) : decode_jpeg16(picture, header);
}

}  // namespace mesamis::detail
