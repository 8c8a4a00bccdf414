// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "mesamis/volume_files/read_volume.h"
#include "mesamis/volume_files/scan_file.h"

/// Shared by the readers of pictures that hold one slice: PNG, BMP and JPEG.
namespace mesamis::detail::volume_files {

/// A warning if the pixels are as large as programs have it that know of screens alone, 72 or 96
/// per inch, or of nothing: one per inch or centimetre.
void warn_of_screen_resolution(double spacing_mm, std::vector<std::string>& warnings);

/// Sets the grid of one slice; x to the left, y to the back, z to the head. Where the spacing is
/// not stated, 1 mm is taken with a warning; between slices always.
/// @param size     pixels along x and y.
/// @param spacing  mm along x and y; zero: not stated.
/// @throws InputError  as set_size().
void set_picture_grid(ScanFile& scan, const std::array<std::int64_t, 2>& size, const Vec3& spacing);

/// The value of a grey pixel: its three colours are equal.
/// @param pixel  its place, for the message.
/// @throws InputError  for a pixel of another colour.
float require_grey(const std::filesystem::path& file, const std::array<unsigned, 3>& color,
                   const std::array<std::int64_t, 2>& pixel);

/// The colours of a table are kept where the values are its indices; a warning says so if the first
/// one, the background, is not black.
/// @param palette  bytes red, green and blue of each colour, `stride` bytes apart.
void keep_palette(ScanFile& scan, std::string_view palette, std::size_t stride = 3);

/// The slice of a grey picture.
/// @param scan      its header, with its grid.
/// @param color_at  color_at(x, y): red, green and blue of a pixel.
/// @throws InputError  as require_grey().
template <class ColorAt>
VolumeFile grey_picture(ScanFile scan, const ColorAt& color_at) {
  VolumeFile out{std::move(scan.grid), scan.format, std::move(scan.warnings)};
  out.volume.samples.reserve(out.volume.voxel_count());
  for (std::int64_t y = 0; y < out.volume.size[1]; ++y) {
    for (std::int64_t x = 0; x < out.volume.size[0]; ++x) {
      out.volume.samples.push_back(require_grey(scan.file, color_at(x, y), {x, y}));
    }
  }
  return out;
}

}  // namespace mesamis::detail::volume_files
