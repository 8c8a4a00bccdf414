// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>

#include "mesamis/scan_files/scan_file.h"

/// Shared by the readers of pictures that hold one slice: PNG and BMP.
namespace mesamis::detail {

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

}  // namespace mesamis::detail
