// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

namespace mesamis::detail {

/// How the bytes of a file are compressed.
enum class Packing {
  kPlain,     ///< not at all
  kDeflated,  ///< a gzip or zlib stream
  kSniffed,   ///< kDeflated if the bytes begin like gzip, else kPlain
};

/// The bytes of a file from an offset to its end, in order, decompressed while they are read.
class ByteSource {
 public:
  /// @param offset  in bytes; where a compressed stream begins, or the first plain byte.
  /// @throws InputError  if the file cannot be read or ends before the offset.
  ByteSource(const std::filesystem::path& file, Packing packing, std::uint64_t offset = 0);
  ~ByteSource();
  ByteSource(const ByteSource&) = delete;
  ByteSource& operator=(const ByteSource&) = delete;

  /// Reads the next n bytes into `out`.
  /// @return  the number of bytes read; less than n only at the end.
  /// @throws InputError  if compressed data are broken or cut off.
  std::size_t read(void* out, std::size_t n);
  /// Skips up to n bytes.
  /// @return  the number of bytes skipped; less than n only at the end.
  /// @throws InputError  as read().
  std::uint64_t skip(std::uint64_t n);
  /// @return  an upper bound of the bytes to read: kMostDeflateRatio times the compressed size.
  std::uint64_t most_bytes() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Reads a whole file, decompressed if it is a gzip file.
/// @throws InputError  as ByteSource.
///
/// Linear in the bytes; memory: the bytes.
std::string read_all(const std::filesystem::path& file);

}  // namespace mesamis::detail
