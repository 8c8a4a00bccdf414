// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace mesamis::detail {

/// The most that deflate can pack: 258 bytes in 2 bits, zlib's own figure. What a file claims of
/// its unpacked bytes is compared with it before memory is taken for them.
inline constexpr std::uint64_t kMostDeflateRatio = 1032;

/// Compresses bytes as one gzip stream, at zlib's fastest level.
/// @param path  the file to be written, for messages.
/// @throws InputError  if zlib cannot be started.
///
/// Linear in the bytes; memory: the compressed bytes.
std::string gzipped(const std::filesystem::path& path, std::string_view bytes);

}  // namespace mesamis::detail
