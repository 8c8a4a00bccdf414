// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <zlib.h>

#include <string>
#include <vector>

#include "support/scan_bytes.h"

/// PNG and BMP files made by hand.
namespace mesamis {

/// A chunk with its checksum.
inline std::string png_chunk(const std::string& type, const std::string& data) {
  const std::string checked = type + data;
  const auto sum = crc32_z(0, reinterpret_cast<const Bytef*>(checked.data()), checked.size());
  return bytes_of(static_cast<std::uint32_t>(data.size()), true) + checked +
         bytes_of(static_cast<std::uint32_t>(sum), true);
}

/// What a PNG is made of; public so that tests may spoil it.
struct PngBytes {
  std::uint32_t width = 4, height = 3;
  int bits = 8, color = 0, interlace = 0;
  std::uint32_t pixels_per_metre = 0;  // 0: not stated
  std::string palette{};
  std::vector<std::string> lines{};  // each begins with its filter
  std::string more{};                // chunks before the pixels

  std::string bytes() const {
    std::string header = bytes_of(width, true) + bytes_of(height, true);
    header +=
        {static_cast<char>(bits), static_cast<char>(color), 0, 0, static_cast<char>(interlace)};
    std::string out = "\x89PNG\r\n\x1a\n" + png_chunk("IHDR", header) + more;
    if (pixels_per_metre > 0) {
      const std::string resolution = bytes_of(pixels_per_metre, true);
      out += png_chunk("pHYs", resolution + resolution + '\1');
    }
    if (!palette.empty()) out += png_chunk("PLTE", palette);
    std::string pixels;
    for (const std::string& line : lines) pixels += line;
    const std::string stream = packed(pixels, 15);
    const std::size_t half = stream.size() / 2;  // the stream may be cut anywhere
    return out + png_chunk("IDAT", stream.substr(0, half)) +
           png_chunk("IDAT", stream.substr(half)) + png_chunk("IEND", "");
  }
};

/// A grey PNG of 8 bits, no filters.
inline std::string png_bytes(std::uint32_t width, std::uint32_t height, const std::string& pixels) {
  PngBytes png;
  png.width = width;
  png.height = height;
  for (std::uint32_t y = 0; y < height; ++y) {
    png.lines.push_back('\0' + pixels.substr(std::size_t{y} * width, width));
  }
  return png.bytes();
}

/// What a BMP is made of.
struct BmpBytes {
  std::int32_t width = 3, height = 2;  // below 0: from the top
  std::uint16_t bits = 8;
  std::uint32_t compression = 0, colors = 0;
  std::int32_t pixels_per_metre = 0;
  std::string palette{};  // blue, green, red, 0
  std::string pixels{};   // lines padded to whole words

  std::string bytes() const {
    const auto start = static_cast<std::uint32_t>(54 + palette.size());
    std::string out = "BM" + bytes_of(static_cast<std::uint32_t>(start + pixels.size()));
    out += bytes_of(std::uint32_t{0}) + bytes_of(start) + bytes_of(std::uint32_t{40});
    out += bytes_of(width) + bytes_of(height) + bytes_of(std::uint16_t{1}) + bytes_of(bits);
    out += bytes_of(compression) + bytes_of(std::uint32_t{0}) + bytes_of(pixels_per_metre) +
           bytes_of(pixels_per_metre);
    return out + bytes_of(colors) + bytes_of(std::uint32_t{0}) + palette + pixels;
  }
};

/// Every grey value as a colour.
inline std::string grey_palette() {
  std::string palette{};
  for (int value = 0; value < 256; ++value)
    palette += std::string(3, static_cast<char>(value)) + '\0';
  return palette;
}

}  // namespace mesamis
