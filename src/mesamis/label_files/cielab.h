// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "mesamis/rooms.h"

namespace mesamis::detail::label_files {

/// Converts DICOM's Recommended Display CIELab Value to sRGB.
///
/// The white of the Lab values is taken to be that of sRGB (D65), as the programs that write
/// segmentations do; colours that sRGB lacks are clamped. Source: PS3.3 C.10.7.1.1, IEC 61966-2-1.
/// @param scaled  L of 0 to 100, a and b of -128 to 127, each scaled to 0 to 65535.
/// @return red, green, blue.
std::array<std::uint8_t, 3> srgb_from_cielab(const std::array<int, 3>& scaled);

}  // namespace mesamis::detail::label_files
