// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "mesamis/files/read_record.h"

namespace mesamis::detail::files {

/// Computes the SHA-256 of a file or a directory (FIPS 180-4).
///
/// @param path  a file, or a directory: then the bytes of its regular files and of those below it,
///              one file after another in the order of their paths, are one message. Names do not
///              count.
/// @return 64 lower-case hexadecimal digits.
/// @throws InputError      if a file cannot be read or a directory holds more than 100 000 files.
/// @throws NumericalError  if libcrypto cannot compute it.
///
/// Linear in the bytes; memory: one buffer of 64 KiB.
std::string sha256(const std::filesystem::path& path);

/// The same of files that were read, one after another: the sum of the very bytes that the reader
/// saw. Whole files count, also where a part was read.
/// @throws InputError      if a file cannot be read, or has changed since it was opened.
/// @throws NumericalError  as sha256() of a path.
///
/// Linear in the bytes; memory: one buffer of 64 KiB.
std::string sha256(const std::vector<ReadFile>& files);

}  // namespace mesamis::detail::files
