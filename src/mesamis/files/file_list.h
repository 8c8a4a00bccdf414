// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <system_error>
#include <vector>

#include "mesamis/rooms.h"

namespace mesamis::detail::files {

/// @return  what the system says of an error, in lower case: "permission denied".
std::string reason_of(const std::error_code& error);
std::string reason_of(int error_number);

/// @throws InputError  if there is neither a file that can be read nor a directory of this path,
///                     with the reason: nothing is there, no permission, a loop of links, a name
///                     too long, or something whose reading could wait for ever, a pipe or a
///                     device.
void require_there(const std::filesystem::path& path);

/// @throws InputError  as require_there(), and for a directory.
void require_file(const std::filesystem::path& path);

/// @return  why a file cannot be opened for reading; empty if it can.
std::string why_unreadable(const std::filesystem::path& file);

/// @return  the size of a file in bytes.
/// @throws InputError  as require_file().
std::uint64_t size_of(const std::filesystem::path& file);

/// @return  the regular files of a directory and of those below it, in the order of their paths.
///          Links to directories are followed; each directory is entered once.
/// @throws InputError  if it cannot be read or holds more than 100 000 files.
std::vector<std::filesystem::path> files_below(const std::filesystem::path& directory);

/// @return  the regular files of this directory alone, in the order of their paths.
/// @throws InputError  as files_below().
std::vector<std::filesystem::path> files_in(const std::filesystem::path& directory);

/// Names what a directory holds, for messages: "ct.nii.gz, notes.txt, the folder masks and 3 more",
/// "nothing". Names that begin with a dot are left out.
/// @throws InputError  as files_below().
std::string contents_of(const std::filesystem::path& directory);

}  // namespace mesamis::detail::files
