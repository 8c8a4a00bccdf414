// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace mesamis::detail {

/// Compresses bytes as one gzip stream, at zlib's fastest level.
/// @param path  the file to be written, for messages.
/// @throws InputError  if zlib cannot be started.
///
/// Linear in the bytes; memory: the compressed bytes.
std::string gzipped(const std::filesystem::path& path, std::string_view bytes);

}  // namespace mesamis::detail
