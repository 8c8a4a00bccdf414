// SPDX-License-Identifier: Apache-2.0
// Grey pictures as uncompressed Windows bitmaps, one slice each.
#include <array>
#include <cstdlib>
#include <string>

#include "mesamis/files/byte_source.h"
#include "mesamis/files/bytes.h"
#include "mesamis/files/refuse.h"
#include "mesamis/volume_files/formats.h"
#include "mesamis/volume_files/grey_pixels.h"

namespace mesamis::detail::volume_files {
namespace {

constexpr std::size_t kFileHeader = 14, kSmallestInfo = 40;

struct Bmp {
  std::string bytes;
  std::int64_t width = 0, height = 0;
  bool bottom_up = true;
  bool labels = false;  ///< the values are the indices of the palette
  std::size_t bits = 0, colors = 0;
  std::uint64_t palette = 0, pixels = 0;  ///< where they begin
  Vec3 spacing;                           ///< mm; zero: not stated

  bool has_palette() const { return bits <= 8; }
  /// Lines are padded to whole words of 4 bytes.
  std::uint64_t line_bytes() const {
    return (static_cast<std::uint64_t>(width) * bits + 31) / 32 * 4;
  }
};

template <class Number>
Number number(const Bmp& bmp, std::size_t at) {
  return load<Number>(bmp.bytes.data() + at);
}

/// Pixels per metre.
Vec3 resolution(std::int32_t x, std::int32_t y) {
  return x > 0 && y > 0 ? Vec3{1000.0 / x, 1000.0 / y, 0} : Vec3{};
}

/// Everything that the headers claim must fit into the file.
void require_complete(const std::filesystem::path& file, const Bmp& bmp) {
  const std::uint64_t needed =
      bmp.pixels + static_cast<std::uint64_t>(bmp.height) * bmp.line_bytes();
  if (bmp.bytes.size() < needed) {
    refuse(file, message("expected ", needed, " bytes for ", bmp.width, " x ", bmp.height,
                         " pixels of ", bmp.bits, " bits, found ", bmp.bytes.size()));
  }
  if (bmp.has_palette() && bmp.palette + 4 * bmp.colors > bmp.bytes.size()) {
    refuse(file, message("the table of ", bmp.colors, " colours is cut off"));
  }
}

bool is_bit_depth(std::size_t bits) {
  return bits == 1 || bits == 4 || bits == 8 || bits == 24 || bits == 32;
}

Bmp parse(const std::filesystem::path& file, const Opening& opening) {
  Bmp bmp;
  bmp.labels = opening.labels;
  bmp.bytes = read_all(file, opening.budget);
  if (!bmp.bytes.starts_with("BM") || bmp.bytes.size() < kFileHeader + kSmallestInfo ||
      number<std::uint32_t>(bmp, 14) < kSmallestInfo) {
    refuse(file, "expected a BMP file, found something else or a cut off one");
  }
  const std::int64_t height = number<std::int32_t>(bmp, 22);
  bmp.width = number<std::int32_t>(bmp, 18);
  bmp.height = std::abs(height);
  bmp.bottom_up = height > 0;
  bmp.bits = number<std::uint16_t>(bmp, 28);
  const auto compression = number<std::uint32_t>(bmp, 30);
  if (compression != 0 || !is_bit_depth(bmp.bits)) {
    refuse(file, message("expected uncompressed pixels of 1, 4, 8, 24 or 32 bits, found ", bmp.bits,
                         " bits, compression ", compression));
  }
  bmp.pixels = number<std::uint32_t>(bmp, 10);
  bmp.palette = kFileHeader + std::uint64_t{number<std::uint32_t>(bmp, 14)};
  const auto colors = number<std::uint32_t>(bmp, 46);
  const std::size_t most = bmp.has_palette() ? std::size_t{1} << bmp.bits : 0;
  bmp.colors = colors == 0 || colors > most ? most : colors;
  bmp.spacing = resolution(number<std::int32_t>(bmp, 38), number<std::int32_t>(bmp, 42));
  return bmp;
}

/// The table has blue, green, red and a byte without meaning.
void keep_colors(ScanFile& scan, const Bmp& bmp) {
  std::string colors;
  for (std::size_t n = 0; n < bmp.colors; ++n) {
    for (std::size_t c = 3; c-- > 0;) colors += bmp.bytes[bmp.palette + 4 * n + c];
  }
  keep_palette(scan, colors);
}

/// Also checks that the file holds what it claims.
ScanFile scan_of(const std::filesystem::path& file, const Bmp& bmp) {
  ScanFile scan{file, "BMP", {}, {}, {}};
  set_picture_grid(scan, {bmp.width, bmp.height}, bmp.spacing);
  scan.source.type = NumberType::kUint8;
  require_complete(file, bmp);
  if (bmp.labels && bmp.has_palette()) keep_colors(scan, bmp);
  return scan;
}

/// Blue, green, red at a place of the file.
std::array<unsigned, 3> color_at(const Bmp& bmp, std::uint64_t at) {
  std::array<unsigned, 3> color{};
  for (std::size_t c = 0; c < 3; ++c) color[2 - c] = static_cast<unsigned char>(bmp.bytes[at + c]);
  return color;
}

std::array<unsigned, 3> pixel_color(const std::filesystem::path& file, const Bmp& bmp,
                                    std::uint64_t line, std::uint64_t x) {
  if (!bmp.has_palette()) return color_at(bmp, line + x * bmp.bits / 8);
  const std::size_t byte = static_cast<unsigned char>(bmp.bytes[line + x * bmp.bits / 8]);
  const unsigned entry = static_cast<unsigned>(byte >> (8 - bmp.bits - x * bmp.bits % 8) &
                                               ((std::size_t{1} << bmp.bits) - 1));
  if (entry >= bmp.colors) {
    refuse(file, message("a pixel names colour ", entry, " of ", bmp.colors));
  }
  if (bmp.labels) return {entry, entry, entry};
  return color_at(bmp, bmp.palette + std::uint64_t{4} * entry);
}

}  // namespace

ScanFile open_bmp(const std::filesystem::path& file, const Opening& opening) {
  return scan_of(file, parse(file, opening));
}

VolumeFile read_bmp(const std::filesystem::path& file, const Opening& opening) {
  MemoryBudget& budget = opening.budget;
  const Bmp bmp = parse(file, opening);
  ScanFile scan = scan_of(file, bmp);
  budget.claim(scan.grid.voxel_count(), sizeof(float), "samples");
  return grey_picture(std::move(scan), [&](std::int64_t x, std::int64_t y) {
    const auto stored = static_cast<std::uint64_t>(bmp.bottom_up ? bmp.height - 1 - y : y);
    const std::uint64_t line = bmp.pixels + stored * bmp.line_bytes();
    return pixel_color(file, bmp, line, static_cast<std::uint64_t>(x));
  });
}

}  // namespace mesamis::detail::volume_files
