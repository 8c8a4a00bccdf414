// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "mesamis/rooms.h"

/// Files that belong to a process as long as it lives, and can be told from those that a killed
/// process has left: the owner holds an exclusive lock (flock), which the system gives back however
/// the process ends. The number of the process would not do: in a container it is always the same.
namespace mesamis::detail::files {

/// @return  a name that nobody has in a folder: ".mesamis-", 16 random digits, ".unfinished".
/// @throws InputError  if the system has no random numbers.
std::filesystem::path new_name(const std::filesystem::path& folder);

/// Creates an empty file and locks it. On a file system without locks the file is made all the
/// same, and is never taken for abandoned.
/// @return  the descriptor that holds the lock, which the caller closes; -1 and errno if the file
///          cannot be made, EEXIST if there is one.
int create_owned(const std::filesystem::path& file) noexcept;

/// Whether a file is this user's and nobody holds its lock.
/// @return  false also where that cannot be told.
bool is_abandoned(const std::filesystem::path& file) noexcept;

/// Removes the files with names of new_name() in a folder whose owners are gone. All else stays.
void remove_abandoned(const std::filesystem::path& folder) noexcept;

}  // namespace mesamis::detail::files
