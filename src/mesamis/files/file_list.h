// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

namespace mesamis::detail {

/// @return  the size of a file in bytes.
/// @throws InputError  if it is not a file or cannot be read.
std::uint64_t size_of(const std::filesystem::path& file);

/// @return  the regular files of a directory and of those below it, in the order of their paths.
///          Links to directories are not followed.
/// @throws InputError  if it cannot be read or holds more than 100 000 files.
std::vector<std::filesystem::path> files_below(const std::filesystem::path& directory);

/// @return  the regular files of this directory alone, in the order of their paths.
/// @throws InputError  as files_below().
std::vector<std::filesystem::path> files_in(const std::filesystem::path& directory);

}  // namespace mesamis::detail
