// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

#include "mesamis/rooms.h"

namespace mesamis::detail::files {

/// The most that deflate can pack: 258 bytes in 2 bits, zlib's own figure. What a file claims of
/// its unpacked bytes is compared with it before memory is taken for them.
inline constexpr std::uint64_t kMostDeflateRatio = 1032;

/// Compresses bytes that come in parts as one gzip stream: the same bytes, however they are cut.
class Deflater {
 public:
  /// Starts a stream.
  /// @param path   the file to be written, for messages.
  /// @param level  zlib's, 1 (fastest) to 9 (smallest).
  /// @throws InputError  if zlib cannot be started.
  explicit Deflater(const std::filesystem::path& path, int level = 1);
  ~Deflater();
  Deflater(const Deflater&) = delete;
  Deflater& operator=(const Deflater&) = delete;

  /// Takes the next bytes.
  /// @return what zlib hands out by now; the rest comes later.
  ///
  /// Linear in the bytes; memory: what is returned.
  std::string add(std::string_view bytes);
  /// Ends the stream, once.
  /// @return its last bytes.
  std::string finish();

 private:
  struct Stream;
  std::unique_ptr<Stream> stream_;
};

/// Compresses bytes as one gzip stream.
/// @param path   the file to be written, for messages.
/// @param level  zlib's, 1 (fastest) to 9 (smallest).
/// @throws InputError  if zlib cannot be started.
///
/// Linear in the bytes; memory: the compressed bytes.
std::string gzipped(const std::filesystem::path& path, std::string_view bytes, int level = 1);

}  // namespace mesamis::detail::files
