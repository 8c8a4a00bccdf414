// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "mesamis/rooms.h"

namespace mesamis::detail::volume_files {

/// One step of how a chunk is packed.
struct ChunkCodec {
  enum class Kind {
    kDeflate,     ///< a gzip or zlib stream
    kBlosc,       ///< a Blosc 1 buffer
    kZstd,        ///< one frame
    kShuffle,     ///< the first bytes of all elements, then the second ones, ...
    kCrc32c,      ///< four bytes behind the others
    kFletcher32,  ///< as HDF5 writes it, four bytes behind the others
  };
  Kind kind = Kind::kDeflate;
  std::size_t element = 1;  ///< kShuffle: bytes
};

/// Steps in the order of packing: of those that compress there is one at most, and nothing but
/// checksums after it.
/// @throws InputError  naming the file otherwise.
void require_chain(const std::filesystem::path& file, const std::vector<ChunkCodec>& codecs);

/// The bytes of a chunk, unpacked.
/// @param packed  the bytes as stored; claimed by the caller.
/// @param codecs  as require_chain() lets pass.
/// @param size    bytes of the chunk: other numbers are refused before memory is taken for them.
/// @throws InputError  if they are broken, cut off, or not as many as said.
///
/// O(bytes); memory: the bytes of the chunk, twice where they are shuffled.
std::string unpack_chunk(const std::filesystem::path& file, std::string packed,
                         const std::vector<ChunkCodec>& codecs, std::size_t size);

}  // namespace mesamis::detail::volume_files
