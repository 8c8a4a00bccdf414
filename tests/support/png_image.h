// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <filesystem>

#include "support/png_pixels.h"
#include "support/temp_folder.h"

namespace mesamis {

struct Rgb {
  int r, g, b;
  bool is_white() const { return r > 250 && g > 250 && b > 250; }
  bool is_bright_grey() const { return r > 150 && r == g && g == b; }
  bool is_orange() const { return r - b > 60; }
};

/// A picture read back; row 0 is the lowest.
class Image {
 public:
  explicit Image(const std::filesystem::path& png) : pixels_(read_bytes(png)) {}
  std::array<int, 2> size() const {
    return {static_cast<int>(pixels_.width), static_cast<int>(pixels_.height)};
  }
  Rgb at(int x, int y) const {
    const auto c =
        pixels_.at(static_cast<std::size_t>(x), pixels_.height - 1 - static_cast<std::size_t>(y));
    return {c.r, c.g, c.b};
  }

 private:
  PngPixels pixels_;
};

}  // namespace mesamis
