// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "mesamis/files/json_value.h"
#include "mesamis/volume_files/chunk_array.h"

/// The metadata of one array in a Zarr store.
namespace mesamis::detail::volume_files {

/// A file of many chunks, with a table of where each lies.
struct ZarrShard {
  std::vector<std::uint64_t> chunks;  ///< in a shard along each axis, the slowest first
  bool index_at_end = true;
  bool index_has_sum = false;  ///< CRC-32C of four bytes behind it

  /// Bytes of the table: place and size of each chunk, and the sum.
  std::uint64_t index_bytes() const noexcept;
};

struct ZarrArray {
  ChunkLayout layout;
  std::optional<ZarrShard> shard{};
  std::string prefix;    ///< of the names of chunks: "c/", or nothing
  char separator = '.';  ///< between the numbers in them
};

/// Reads the content of .zarray (version 2), or of zarr.json (version 3) of an array.
/// @throws InputError  naming the file: what is not supported, or contradicts the format.
///
/// The layout is not checked: require_layout() does.
ZarrArray read_zarr_v2(const JsonValue& metadata);
ZarrArray read_zarr_v3(const JsonValue& metadata);

/// The name of a chunk's or a shard's file below the array's folder: "0.3.12", "c/0/3/12".
std::string chunk_name(const ZarrArray& array, const std::vector<std::uint64_t>& place);

}  // namespace mesamis::detail::volume_files
