// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "mesamis/rooms.h"

namespace mesamis::detail::volume_files {

/// Names the format of a file that is not read, by its extension, and what to save it as: "a Zeiss
/// CZI file: save it as OME-TIFF".
/// @return empty for an extension of no known format.
///
/// O(1).
std::string foreign_format(const std::filesystem::path& file);

}  // namespace mesamis::detail::volume_files
