// SPDX-License-Identifier: Apache-2.0
#include "mesamis/picture/raster.h"

#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>

#include "mesamis/base/error.h"

namespace mesamis::detail::picture {
namespace {

void append_big_endian(std::string& to, std::uint32_t value) {
  for (int shift = 24; shift >= 0; shift -= 8) to += static_cast<char>(value >> shift & 255U);
}

void append_chunk(std::string& png, const std::string& kind, const std::string& data) {
  append_big_endian(png, static_cast<std::uint32_t>(data.size()));
  const std::string body = kind + data;
  png += body;
  const auto* bytes = reinterpret_cast<const Bytef*>(body.data());
  append_big_endian(png,
                    static_cast<std::uint32_t>(crc32(0, bytes, static_cast<uInt>(body.size()))));
}

std::uint8_t paeth(int left, int up, int corner) {
  const int p = left + up - corner;
  const int to_left = std::abs(p - left), to_up = std::abs(p - up),
            to_corner = std::abs(p - corner);
  if (to_left <= to_up && to_left <= to_corner) return static_cast<std::uint8_t>(left);
  return static_cast<std::uint8_t>(to_up <= to_corner ? up : corner);
}

/// A row as one of PNG's five filters leaves it, and how far it is from zeros.
struct FilteredRow {
  std::string bytes;
  std::int64_t cost = 0;
};

FilteredRow filtered(const Raster& picture, int y, int filter) {
  const std::size_t step = picture.channels();
  const std::size_t length = static_cast<std::size_t>(picture.width) * step;
  const std::uint8_t* row = picture.bytes.data() + picture.offset(0, y);
  const std::uint8_t* above = y > 0 ? row - length : nullptr;
  FilteredRow result{std::string(1, static_cast<char>(filter)), 0};
  result.bytes.reserve(length + 1);
  for (std::size_t n = 0; n < length; ++n) {
    const int left = n >= step ? row[n - step] : 0, up = above != nullptr ? above[n] : 0;
    const int corner = n >= step && above != nullptr ? above[n - step] : 0;
    const std::array<int, 5> guess{0, left, up, (left + up) / 2, paeth(left, up, corner)};
    const auto byte = static_cast<std::int8_t>(
        static_cast<std::uint8_t>(row[n] - guess[static_cast<std::size_t>(filter)]));
    result.bytes += static_cast<char>(byte);
    result.cost += std::abs(static_cast<int>(byte));
  }
  return result;
}

std::string filtered(const Raster& picture) {
  std::string rows;
  rows.reserve(picture.bytes.size() + static_cast<std::size_t>(picture.height));
  for (int y = 0; y < picture.height; ++y) {
    FilteredRow best{{}, std::numeric_limits<std::int64_t>::max()};
    for (int filter = 0; filter < 5; ++filter) {
      FilteredRow row = filtered(picture, y, filter);
      if (row.cost < best.cost) best = std::move(row);
    }
    rows += best.bytes;
  }
  return rows;
}

std::string deflated(const std::string& bytes) {
  uLongf size = compressBound(static_cast<uLong>(bytes.size()));
  std::string packed(size, '\0');
  if (compress2(reinterpret_cast<Bytef*>(packed.data()), &size,
                reinterpret_cast<const Bytef*>(bytes.data()), static_cast<uLong>(bytes.size()),
                Z_DEFAULT_COMPRESSION) != Z_OK) {
    throw InputError("PNG: expected zlib to compress a picture, found no memory");
  }
  packed.resize(size);
  return packed;
}

double distance_to(const std::array<double, 2>& p, const std::array<double, 2>& a,
                   const std::array<double, 2>& b) {
  const double dx = b[0] - a[0], dy = b[1] - a[1], square = dx * dx + dy * dy;
  const double along = square > 0 ? ((p[0] - a[0]) * dx + (p[1] - a[1]) * dy) / square : 0;
  const double t = std::clamp(along, 0.0, 1.0);
  return std::hypot(p[0] - a[0] - t * dx, p[1] - a[1] - t * dy);
}

/// The first pixel at or after a place, within a picture of that size.
int first_pixel(double at, int size) {
  return static_cast<int>(std::clamp(std::floor(at), 0.0, double{1} * size));
}
int last_pixel(double at, int size) {
  return static_cast<int>(std::clamp(std::floor(at), -1.0, size - 1.0));
}

/// Calls visit(x, y, share) for each pixel that a line of round ends covers in part.
template <class Visit>
void visit_line(const std::array<Place, 2>& ends, double width, const std::array<int, 2>& size,
                const Visit& visit) {
  const auto& [from, to] = ends;
  const double reach = width / 2 + 1;
  const int first_x = first_pixel(std::min(from[0], to[0]) - reach, size[0]);
  const int last_x = last_pixel(std::max(from[0], to[0]) + reach, size[0]);
  const int first_y = first_pixel(std::min(from[1], to[1]) - reach, size[1]);
  const int last_y = last_pixel(std::max(from[1], to[1]) + reach, size[1]);
  for (int y = first_y; y <= last_y; ++y) {
    for (int x = first_x; x <= last_x; ++x) {
      const double share =
          std::clamp(width / 2 + 0.5 - distance_to({x + 0.5, y + 0.5}, from, to), 0.0, 1.0);
      if (share > 0) visit(x, y, share);
    }
  }
}

}  // namespace

Raster blank(int width, int height, const Colour& colour) {
  Raster picture{width, height, false, {}};
  picture.bytes.reserve(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * 3);
  for (int n = 0; n < width * height; ++n) {
    picture.bytes.insert(picture.bytes.end(), colour.begin(), colour.end());
  }
  return picture;
}

Raster halved(const Raster& large) {
  Raster small{large.width / 2, large.height / 2, large.grey, {}};
  small.bytes.resize(small.offset(0, small.height));
  for (int y = 0; y < small.height; ++y) {
    for (int x = 0; x < small.width; ++x) {
      for (std::size_t c = 0; c < small.channels(); ++c) {
        const int sum = large.bytes[large.offset(2 * x, 2 * y) + c] +
                        large.bytes[large.offset(2 * x + 1, 2 * y) + c] +
                        large.bytes[large.offset(2 * x, 2 * y + 1) + c] +
                        large.bytes[large.offset(2 * x + 1, 2 * y + 1) + c];
        small.bytes[small.offset(x, y) + c] = static_cast<std::uint8_t>((sum + 2) / 4);
      }
    }
  }
  return small;
}

Raster enlarged(const Raster& grey, int columns, int rows) {
  Raster large = blank(grey.width * columns, grey.height * rows, {});
  for (int y = 0; y < large.height; ++y) {
    for (int x = 0; x < large.width; ++x) {
      const std::uint8_t value = grey.bytes[grey.offset(x / columns, y / rows)];
      std::fill_n(large.bytes.data() + large.offset(x, y), 3, value);
    }
  }
  return large;
}

void mix(Raster& on, const std::array<int, 2>& pixel, const Colour& colour, double share) {
  std::uint8_t* bytes = on.bytes.data() + on.offset(pixel[0], pixel[1]);
  for (std::size_t c = 0; c < 3; ++c) {
    bytes[c] = static_cast<std::uint8_t>(std::lround((1 - share) * bytes[c] + share * colour[c]));
  }
}

void draw_line(Raster& on, const std::array<Place, 2>& ends, double width, const Colour& colour) {
  visit_line(ends, width, {on.width, on.height}, [&](int x, int y, double share) {
    mix(on, {x, y}, colour, share);
  });
}

void draw_lines(Raster& on, std::span<const std::array<Place, 2>> lines, double width,
                const Colour& colour) {
  const auto columns = static_cast<std::size_t>(on.width);
  std::vector<float> covered(columns * static_cast<std::size_t>(on.height), 0.0F);
  for (const auto& ends : lines) {
    visit_line(ends, width, {on.width, on.height}, [&](int x, int y, double share) {
      float& most = covered[static_cast<std::size_t>(y) * columns + static_cast<std::size_t>(x)];
      most = std::max(most, static_cast<float>(share));
    });
  }
  for (int y = 0; y < on.height; ++y) {
    for (int x = 0; x < on.width; ++x) {
      const float share =
          covered[static_cast<std::size_t>(y) * columns + static_cast<std::size_t>(x)];
      if (share > 0) mix(on, {x, y}, colour, share);
    }
  }
}

void fill_rectangle(Raster& on, const std::array<Place, 2>& corners, const Colour& colour) {
  const auto [left, right] = std::minmax(corners[0][0], corners[1][0]);
  const auto [top, bottom] = std::minmax(corners[0][1], corners[1][1]);
  const auto covered = [](int pixel, double lo, double hi) {
    return std::clamp(std::min(hi, pixel + 1.0) - std::max(lo, double{1} * pixel), 0.0, 1.0);
  };
  for (int y = first_pixel(top, on.height); y <= last_pixel(bottom, on.height); ++y) {
    for (int x = first_pixel(left, on.width); x <= last_pixel(right, on.width); ++x) {
      mix(on, {x, y}, colour, covered(x, left, right) * covered(y, top, bottom));
    }
  }
}

std::string png_bytes(const Raster& picture) {
  std::string png = "\x89PNG\r\n\x1a\n", header;
  append_big_endian(header, static_cast<std::uint32_t>(picture.width));
  append_big_endian(header, static_cast<std::uint32_t>(picture.height));
  header += {8, static_cast<char>(picture.grey ? 0 : 2), 0, 0, 0};
  append_chunk(png, "IHDR", header);
  append_chunk(png, "IDAT", deflated(filtered(picture)));
  append_chunk(png, "IEND", {});
  return png;
}

}  // namespace mesamis::detail::picture
