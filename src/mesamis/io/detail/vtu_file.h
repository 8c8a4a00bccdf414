// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string_view>

#include "mesamis/io/mesh_files.h"

namespace mesamis::detail {

/// The field data that say in which frame the points of a .vtu are, and the value for RAS.
inline constexpr const char* kFrameName = "SPACE";
inline constexpr const char* kRasName = "RAS";

/// A .vtu as it lies in the file.
struct VtuContents {
  MeshWithArrays grid;
  Frame frame = Frame::kLps;
};

/// @param file   for messages
/// @param bytes  the whole file
/// @throws InputError  if it is not a .vtu of tetrahedra alone, or is damaged. Nothing is
///                     allocated beyond what a file of that size can hold.
VtuContents parse_vtu(const std::filesystem::path& file, std::string_view bytes);

}  // namespace mesamis::detail
