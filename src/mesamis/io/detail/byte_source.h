// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

namespace mesamis::detail {

enum class Packing {
  kPlain,     ///< bytes as they lie in the file
  kDeflated,  ///< a gzip or zlib stream
  kSniffed,   ///< kDeflated if the bytes begin like gzip, else kPlain
};

/// The bytes of a file from an offset to its end, unpacked on the way, in order.
class ByteSource {
 public:
  /// @throws InputError  if the file cannot be read or ends before the offset.
  ByteSource(const std::filesystem::path& file, Packing packing, std::uint64_t offset = 0);
  ~ByteSource();
  ByteSource(const ByteSource&) = delete;
  ByteSource& operator=(const ByteSource&) = delete;

  /// Fills `out`; fewer than n bytes only at the end.
  /// @throws InputError  if packed data are broken or cut off.
  std::size_t read(void* out, std::size_t n);
  /// Steps over up to n bytes and says how many there were.
  std::uint64_t skip(std::uint64_t n);
  /// No source of this kind gives more bytes than this, whatever its header says.
  std::uint64_t most_bytes() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// All bytes of a file, unpacked if it is a gzip file.
/// @throws InputError  as ByteSource.
std::string read_all(const std::filesystem::path& file);

}  // namespace mesamis::detail
