// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

#include "mesamis/files/memory_budget.h"

namespace mesamis::detail::files {

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
  /// Skips up to n bytes; plain ones are not read.
  /// @return  the number of bytes skipped; less than n only at the end.
  /// @throws InputError  as read().
  std::uint64_t skip(std::uint64_t n);
  /// @return  an upper bound of the bytes to read: kMostDeflateRatio times the compressed size, or
  ///          the very number of plain ones.
  std::uint64_t most_bytes() const;
  /// @return  whether the bytes are decompressed, so that all before one are needed to read it.
  bool is_packed() const noexcept;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// How many bytes a file can have by what its first bytes say; 0: they do not tell.
using MostBytes = std::uint64_t (*)(std::string_view first_bytes);

/// How many bytes a MostBytes gets, fewer where the file ends before.
inline constexpr std::size_t kFirstBytes = 512;

/// Reads a whole file, decompressed if it is a gzip file.
/// @param budget  of the reader: the bytes are claimed as they come, and held afterwards.
/// @param most    bytes beyond those that it justifies are not read; null: all are.
/// @throws InputError  as ByteSource and MemoryBudget::claim().
///
/// Linear in the bytes; memory: the bytes, twice while they grow.
std::string read_all(const std::filesystem::path& file, MemoryBudget& budget,
                     MostBytes most = nullptr);

}  // namespace mesamis::detail::files
