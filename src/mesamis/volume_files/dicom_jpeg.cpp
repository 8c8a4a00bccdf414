// SPDX-License-Identifier: Apache-2.0
#include "mesamis/volume_files/dicom_jpeg.h"

#include <algorithm>
#include <array>
#include <limits>

namespace mesamis::detail::volume_files {
namespace {

int big16(Bytes b, std::size_t at) { return b[at] << 8 | b[at + 1]; }

std::uint64_t big32(Bytes b, std::size_t at) {
  return static_cast<std::uint64_t>(big16(b, at)) << 16 | static_cast<unsigned>(big16(b, at + 2));
}

constexpr std::uint64_t kUnbounded = std::numeric_limits<std::uint64_t>::max();
constexpr std::uint64_t kMostTiles = 65535;  // as the standard has it

/// What the segments of a codestream of JPEG 2000 state of its structure, at its most costly.
struct CodingStyle {
  bool stated = false;                  ///< there was a COD segment
  std::uint64_t columns = 0, rows = 0;  ///< of a tile
  unsigned most_levels = 0;             ///< of the wavelet, 32 at most
  std::uint64_t most_layers = 1;
  unsigned least_precinct_bits = 30, least_block_bits = 12;  ///< of their areas, logarithms of 2
};

/// Levels, code blocks and precincts of a COD or COC segment.
bool take_style(Bytes b, bool has_precincts, CodingStyle& style) {
  if (b.size() < 5 || b[0] > 32) return false;
  style.most_levels = std::max<unsigned>(style.most_levels, b[0]);
  const unsigned block_bits = (b[1] & 15u) + (b[2] & 15u) + 4;
  style.least_block_bits = std::min(style.least_block_bits, block_bits);
  const std::size_t sizes = has_precincts ? b[0] + std::size_t{1} : 0;
  if (b.size() < 5 + sizes) return false;
  for (const unsigned char size : b.subspan(5, sizes)) {
    style.least_precinct_bits = std::min(style.least_precinct_bits, (size & 15u) + (size >> 4));
  }
  return true;
}

/// @param segment  without marker and length.
bool take_segment(int marker, Bytes segment, CodingStyle& style) {
  constexpr int kCod = 0xff52, kCoc = 0xff53;
  if (marker == kCod) {
    if (segment.size() < 10) return false;
    style.stated = true;
    style.most_layers = std::max(style.most_layers, static_cast<std::uint64_t>(big16(segment, 2)));
    return take_style(segment.subspan(5), (segment[0] & 1) != 0, style);
  }
  if (marker == kCoc) {  // of the one component there is
    return segment.size() >= 2 && take_style(segment.subspan(2), (segment[1] & 1) != 0, style);
  }
  return true;
}

/// Follows the segments of the main header and of all tile parts.
/// @return  false if it cannot.
bool find_coding_style(Bytes b, CodingStyle& style) {
  constexpr int kStartOfTile = 0xff90, kStartOfData = 0xff93, kEnd = 0xffd9;
  if (b.size() < 32) return false;
  style.columns = big32(b, 24);
  style.rows = big32(b, 28);
  std::size_t at = 2, tile_end = 0;
  while (at + 2 <= b.size()) {
    const int marker = big16(b, at);
    if (marker == kEnd) return true;
    if (marker == kStartOfData) {  // a tile of length 0 goes on to the end
      if (tile_end == 0) return true;
      at = std::max(tile_end, at + 2);
      continue;
    }
    if (at + 4 > b.size()) return false;
    const auto length = static_cast<std::size_t>(big16(b, at + 2));
    if (length < 2 || at + 2 + length > b.size()) return false;
    if (marker == kStartOfTile) {
      if (length != 10) return false;
      const std::uint64_t size = big32(b, at + 6);
      tile_end = size == 0 ? 0 : at + size;
    }
    if (!take_segment(marker, b.subspan(at + 4, length - 2), style)) return false;
    at += 2 + length;
  }
  return true;  // whether the end is there is has_end_marker()'s matter
}

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
  const auto signed32 = [b](std::size_t at) { return static_cast<std::int64_t>(big32(b, at)); };
  const std::int64_t columns = signed32(8) - signed32(16), rows = signed32(12) - signed32(20);
  if (columns < 1 || rows < 1 || columns > 65535 || rows > 65535) return std::nullopt;
  return PictureHeader{static_cast<int>(columns), static_cast<int>(rows), big16(b, 40),
                       (b[42] & 0x7f) + 1};
}

std::uint64_t jpeg2000_structure_bytes(Bytes b, std::uint64_t pixels) {
  CodingStyle style;
  if (!find_coding_style(b, style) || !style.stated || style.columns == 0 || style.rows == 0)
    return kUnbounded;
  // Sizes of what OpenJPEG 2.5 keeps of each, rounded up.
  constexpr std::uint64_t kTile = 16'384, kBlock = 1'024, kPrecinct = 512, kInclusion = 2;
  const std::uint64_t columns = big32(b, 8), rows = big32(b, 12);
  const std::uint64_t across = columns / style.columns + 1, down = rows / style.rows + 1;
  if (across > kMostTiles || down > kMostTiles || across * down > 4 * kMostTiles) {
    return kUnbounded;
  }
  const std::uint64_t tiles = across * down;
  const std::uint64_t resolutions = tiles * std::uint64_t{style.most_levels + 1};
  // Each resolution of each tile has a precinct and a block at least in each of three bands.
  const std::uint64_t precincts = 4 * resolutions + 2 * (pixels >> style.least_precinct_bits);
  const std::uint64_t blocks = 12 * resolutions + 2 * (pixels >> style.least_block_bits);
  const std::uint64_t inclusions = precincts * style.most_layers * (style.most_levels + 1);
  return kTile * tiles + kPrecinct * precincts + kBlock * blocks + kInclusion * inclusions;
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

}  // namespace mesamis::detail::volume_files
