// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <zlib.h>

#include <cstdint>
#include <cstdlib>
#include <string>
#include <vector>

namespace mesamis {

/// The pixels of a PNG of 8 bits in red, green and blue, with or without opacity.
struct PngPixels {
  struct Colour {
    int r, g, b;
  };
  std::size_t width = 0, height = 0, channels = 0;
  std::vector<std::uint8_t> bytes;  ///< row by row, the upper one first; empty: it is no such file

  explicit PngPixels(const std::string& png) {
    if (png.size() < 33 || png.substr(1, 3) != "PNG") return;
    width = number(png, 16);
    height = number(png, 20);
    channels = png[25] == 6 ? 4 : 3;
    std::string packed;
    for (std::size_t at = 8; at + 12 <= png.size(); at += 12 + number(png, at)) {
      if (png.substr(at + 4, 4) == "IDAT") packed += png.substr(at + 8, number(png, at));
    }
    std::vector<std::uint8_t> rows(height * (width * channels + 1));
    uLongf size = rows.size();
    if (uncompress(rows.data(), &size, reinterpret_cast<const Bytef*>(packed.data()),
                   packed.size()) == Z_OK) {
      unfilter(rows);
    }
  }
  Colour at(std::size_t x, std::size_t y) const {
    const std::uint8_t* p = bytes.data() + (y * width + x) * channels;
    return {p[0], p[1], p[2]};
  }

 private:
  static std::size_t number(const std::string& png, std::size_t at) {
    std::size_t value = 0;
    for (std::size_t n = at; n < at + 4; ++n)
      value = value << 8 | static_cast<std::uint8_t>(png[n]);
    return value;
  }
  static int paeth(int a, int b, int c) {
    const int pa = std::abs(b - c), pb = std::abs(a - c), pc = std::abs(a + b - 2 * c);
    return pa <= pb && pa <= pc ? a : pb <= pc ? b : c;
  }
  void unfilter(const std::vector<std::uint8_t>& rows) {
    const std::size_t length = width * channels;
    bytes.resize(height * length);
    for (std::size_t y = 0; y < height; ++y) {
      const std::uint8_t* row = rows.data() + y * (length + 1);
      for (std::size_t n = 0; n < length; ++n) {
        std::uint8_t* to = bytes.data() + y * length + n;
        const int a = n >= channels ? to[-static_cast<std::ptrdiff_t>(channels)] : 0;
        const int b = y > 0 ? *(to - length) : 0;
        const int c = n >= channels && y > 0 ? *(to - length - channels) : 0;
        const int guess[] = {0, a, b, (a + b) / 2, paeth(a, b, c)};
        *to = static_cast<std::uint8_t>(row[n + 1] + guess[row[0] < 5 ? row[0] : 0]);
      }
    }
  }
};

}  // namespace mesamis
