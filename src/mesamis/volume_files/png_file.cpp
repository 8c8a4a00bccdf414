// SPDX-License-Identifier: Apache-2.0
// Grey pictures as PNG (ISO/IEC 15948), one slice each.
#include <zlib.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <string>

#include "mesamis/files/byte_source.h"
#include "mesamis/files/bytes.h"
#include "mesamis/files/deflate.h"
#include "mesamis/files/refuse.h"
#include "mesamis/volume_files/formats.h"
#include "mesamis/volume_files/grey_pixels.h"

namespace mesamis::detail::volume_files {
namespace {

constexpr std::string_view kSignature("\x89PNG\r\n\x1a\n", 8);
/// Colour types.
constexpr int kGrey = 0, kRgb = 2, kPalette = 3, kGreyAlpha = 4, kRgba = 6;

struct Png {
  std::int64_t width = 0, height = 0;
  int bits = 0, color = -1;
  bool labels = false;  ///< the values are the indices of the palette
  Vec3 spacing;         ///< mm; zero: not stated
  std::string palette;  ///< red, green, blue of each colour
  std::string packed;   ///< the pixels, as one zlib stream

  std::size_t channels() const {
    return color == kRgb ? 3 : color == kGreyAlpha ? 2 : color == kRgba ? 4 : 1;
  }
  std::size_t line_bytes() const {
    return (static_cast<std::size_t>(width) * channels() * static_cast<std::size_t>(bits) + 7) / 8;
  }
};

std::uint32_t word(std::string_view bytes, std::size_t at) {
  return load<std::uint32_t>(bytes.data() + at, ByteOrder::kBig);
}

bool is_bit_depth(int color, int bits) {
  if (color == kGrey) return bits == 1 || bits == 2 || bits == 4 || bits == 8 || bits == 16;
  if (color == kPalette) return bits == 1 || bits == 2 || bits == 4 || bits == 8;
  return (color == kRgb || color == kGreyAlpha || color == kRgba) && (bits == 8 || bits == 16);
}

void read_header(const std::filesystem::path& file, std::string_view data, Png& png) {
  if (data.size() != 13)
    refuse(file, message("expected a header of 13 bytes, found ", data.size()));
  png.width = word(data, 0);
  png.height = word(data, 4);
  png.bits = static_cast<unsigned char>(data[8]);
  png.color = static_cast<unsigned char>(data[9]);
  if (!is_bit_depth(png.color, png.bits)) {
    refuse(file, message("expected a colour type and bit depth of PNG, found ", png.color, " and ",
                         png.bits));
  }
  if (data[12] != 0) refuse(file, "interlaced PNG is not read: save it without interlacing");
}

/// Pixels per metre.
void read_resolution(std::string_view data, Png& png) {
  if (data.size() != 9 || data[8] != 1 || word(data, 0) == 0 || word(data, 4) == 0) return;
  png.spacing = {1000.0 / word(data, 0), 1000.0 / word(data, 4), 0};
}

void take_chunk(const std::filesystem::path& file, std::string_view type, std::string_view data,
                Png& png) {
  if (png.color < 0 && type != "IHDR") {
    refuse(file, "expected the header first, found " + in_quotes(type));
  }
  if (type == "IHDR") read_header(file, data, png);
  if (type == "pHYs") read_resolution(data, png);
  if (type == "PLTE") png.palette = data;
  if (type == "IDAT") png.packed += data;
}

/// Parses everything but the pixels.
Png parse(const std::filesystem::path& file, const Opening& opening) {
  MemoryBudget& budget = opening.budget;
  const std::string bytes = read_all(file, budget);
  if (!bytes.starts_with(kSignature)) refuse(file, "expected a PNG file, found something else");
  Png png;
  png.labels = opening.labels;
  reserve_within(budget, png.packed, bytes.size(), "packed pixels");
  std::size_t at = kSignature.size();
  std::string_view type;
  while (type != "IEND") {
    const std::size_t left = bytes.size() - at;
    if (left < 12 || word(bytes, at) > left - 12) refuse(file, "the PNG file is cut off");
    const std::size_t length = word(bytes, at);
    const auto checked = std::string_view(bytes).substr(at + 4, length + 4);
    const auto sum = crc32_z(0, reinterpret_cast<const Bytef*>(checked.data()), checked.size());
    type = checked.substr(0, 4);
    if (sum != word(bytes, at + 8 + length)) refuse(file, "broken PNG file: a wrong checksum");
    take_chunk(file, type, checked.substr(4), png);
    at += length + 12;
  }
  return png;
}

/// Lines with their filter bytes. What the header claims is compared with what the data can hold
/// before it is allocated.
std::string unpack(const std::filesystem::path& file, const Png& png, MemoryBudget& budget) {
  const std::uint64_t needed =
      static_cast<std::uint64_t>(png.height) * (std::uint64_t{png.line_bytes()} + 1);
  if (needed > kMostDeflateRatio * png.packed.size()) {
    refuse(file, message("expected ", needed, " bytes of pixels for ", png.width, " x ", png.height,
                         ", found ", png.packed.size(), " packed"));
  }
  budget.claim(needed, 1, "pixels");
  std::string lines(needed, '\0');
  uLongf size = needed;
  const int status =
      uncompress(reinterpret_cast<Bytef*>(lines.data()), &size,
                 reinterpret_cast<const Bytef*>(png.packed.data()), png.packed.size());
  if (status != Z_OK || size != needed) {
    refuse(file, message("broken PNG file: expected ", needed, " bytes of pixels, found ", size,
                         status == Z_OK ? "" : " and broken data"));
  }
  return lines;
}

int paeth(int left, int above, int corner) {
  const int p = left + above - corner;
  const int a = std::abs(p - left), b = std::abs(p - above), c = std::abs(p - corner);
  if (a <= b && a <= c) return left;
  return b <= c ? above : corner;
}

/// What a filter adds to a byte, from the bytes left of it, above, and above left.
int predicted(int filter, int left, int above, int corner) {
  switch (filter) {
    case 1:
      return left;
    case 2:
      return above;
    case 3:
      return (left + above) / 2;
    case 4:
      return paeth(left, above, corner);
    default:
      return 0;
  }
}

/// Undoes the filters in place.
void unfilter(const std::filesystem::path& file, const Png& png, std::string& lines) {
  const std::size_t line = png.line_bytes();
  const std::size_t step =
      std::max<std::size_t>(1, png.channels() * static_cast<std::size_t>(png.bits) / 8);
  const auto byte = [](const char* at) { return int{static_cast<unsigned char>(*at)}; };
  for (std::int64_t y = 0; y < png.height; ++y) {
    char* row = lines.data() + static_cast<std::size_t>(y) * (line + 1) + 1;
    const char* before = y > 0 ? row - line - 1 : nullptr;
    const int filter = byte(row - 1);
    if (filter > 4) refuse(file, message("broken PNG file: filter ", filter, " in line ", y));
    for (std::size_t x = 0; x < line; ++x) {
      const int left = x >= step ? byte(row + x - step) : 0;
      const int above = before ? byte(before + x) : 0;
      const int corner = before && x >= step ? byte(before + x - step) : 0;
      row[x] = static_cast<char>(byte(row + x) + predicted(filter, left, above, corner));
    }
  }
}

/// The n-th number of a line.
unsigned number_at(const char* line, std::size_t n, int bits) {
  if (bits == 16) return load<std::uint16_t>(line + 2 * n, ByteOrder::kBig);
  const std::size_t bit = n * static_cast<std::size_t>(bits);
  const auto byte = static_cast<unsigned char>(line[bit / 8]);
  return byte >> (8 - static_cast<std::size_t>(bits) - bit % 8) & ((1U << bits) - 1);
}

/// The colour of a pixel; grey where there is one channel.
std::array<unsigned, 3> color_at(const Png& png, const char* line, std::size_t x) {
  const std::size_t first = x * png.channels();
  const unsigned value = number_at(line, first, png.bits);
  if (png.color == kPalette && !png.labels) {
    std::array<unsigned, 3> rgb{};
    for (std::size_t c = 0; c < 3; ++c) {
      const std::size_t at = 3 * value + c;
      rgb[c] = at < png.palette.size() ? static_cast<unsigned char>(png.palette[at]) : 0;
    }
    return rgb;
  }
  if (png.channels() < 3) return {value, value, value};
  return {value, number_at(line, first + 1, png.bits), number_at(line, first + 2, png.bits)};
}

ScanFile scan_of(const std::filesystem::path& file, const Png& png) {
  ScanFile scan{file, "PNG", {}, {}, {}};
  set_picture_grid(scan, {png.width, png.height}, png.spacing);
  scan.source.type = png.bits == 16 ? NumberType::kUint16 : NumberType::kUint8;
  if (png.color == kPalette && png.labels) keep_palette(scan, png.palette);
  return scan;
}

}  // namespace

ScanFile open_png(const std::filesystem::path& file, const Opening& opening) {
  return scan_of(file, parse(file, opening));
}

VolumeFile read_png(const std::filesystem::path& file, const Opening& opening) {
  MemoryBudget& budget = opening.budget;
  const Png png = parse(file, opening);
  ScanFile scan = scan_of(file, png);
  std::string lines = unpack(file, png, budget);
  budget.claim(scan.grid.voxel_count(), sizeof(float), "samples");
  unfilter(file, png, lines);
  return grey_picture(std::move(scan), [&](std::int64_t x, std::int64_t y) {
    const char* line = lines.data() + static_cast<std::size_t>(y) * (png.line_bytes() + 1) + 1;
    return color_at(png, line, static_cast<std::size_t>(x));
  });
}

}  // namespace mesamis::detail::volume_files
