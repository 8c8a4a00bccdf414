// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "mesamis/rooms.h"

/// Pictures of pixels, and PNG files of them.
namespace mesamis::detail::picture {

/// Red, green and blue (sRGB).
using Colour = std::array<std::uint8_t, 3>;

/// A picture; the first row is the upper one.
struct Raster {
  int width = 0, height = 0;
  bool grey = false;                ///< one byte per pixel, else three
  std::vector<std::uint8_t> bytes;  ///< row by row

  std::size_t channels() const { return grey ? 1 : 3; }
  std::size_t offset(int x, int y) const {
    return (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
            static_cast<std::size_t>(x)) *
           channels();
  }
};

/// A picture in one colour.
/// @param width,height  pixels, at least 0.
Raster blank(int width, int height, const Colour& colour);

/// Means of blocks of 2 x 2 pixels: what was drawn twice as large gets smooth edges.
/// @param large  of even width and height.
Raster halved(const Raster& large);

/// A grey picture as a coloured one, each pixel as so many to the right and downwards.
Raster enlarged(const Raster& grey, int columns, int rows);

/// Calls visit(x, y, in_b, in_c) for each pixel of a picture whose middle lies in a triangle, with
/// the barycentric coordinates of the second and the third corner there.
/// @param corners  pixels from the upper left corner.
/// @param size     width and height of the picture, pixels.
///
/// O(pixels of the box around the triangle).
template <class Visit>
void visit_pixels(const std::array<std::array<double, 2>, 3>& corners,
                  const std::array<int, 2>& size, Visit visit) {
  const auto& [a, b, c] = corners;
  const double area = (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1]);
  if (area == 0) return;
  const auto pixel = [&](double at, std::size_t axis) {
    return static_cast<int>(std::clamp(std::floor(at), 0.0, size[axis] - 1.0));
  };
  const int first_x = pixel(std::min({a[0], b[0], c[0]}), 0);
  const int last_x = pixel(std::max({a[0], b[0], c[0]}), 0);
  const int first_y = pixel(std::min({a[1], b[1], c[1]}), 1);
  const int last_y = pixel(std::max({a[1], b[1], c[1]}), 1);
  for (int y = first_y; y <= last_y; ++y) {
    for (int x = first_x; x <= last_x; ++x) {
      const double px = x + 0.5 - a[0], py = y + 0.5 - a[1];
      const double in_b = (px * (c[1] - a[1]) - (c[0] - a[0]) * py) / area;
      const double in_c = ((b[0] - a[0]) * py - px * (b[1] - a[1])) / area;
      if (in_b >= 0 && in_c >= 0 && in_b + in_c <= 1) visit(x, y, in_b, in_c);
    }
  }
}

/// A place in a picture: pixels to the right and downwards from its upper left corner.
using Place = std::array<double, 2>;

/// Draws a line of round ends onto a coloured picture, with smooth edges.
/// @param width  pixels.
void draw_line(Raster& on, const std::array<Place, 2>& ends, double width, const Colour& colour);

/// Draws lines as one shape: where they meet or cross nothing is drawn twice.
/// @param width  pixels.
///
/// Four bytes per pixel of the picture beside it.
void draw_lines(Raster& on, std::span<const std::array<Place, 2>> lines, double width,
                const Colour& colour);

/// Fills an upright rectangle of a coloured picture; pixels that it covers in part are mixed.
/// @param corners  any two that are opposite; what lies outside the picture is left out.
void fill_rectangle(Raster& on, const std::array<Place, 2>& corners, const Colour& colour);

/// Mixes a colour into one pixel of a coloured picture.
/// @param share  of the new colour, 0 to 1.
void mix(Raster& on, const std::array<int, 2>& pixel, const Colour& colour, double share);

/// A PNG file: 8 bits per channel, no interlacing, each row filtered in the way that makes it
/// smallest, no words. The same picture gives the same bytes.
/// @throws InputError  if zlib cannot be started.
std::string png_bytes(const Raster& picture);

}  // namespace mesamis::detail::picture
