// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "mesamis/files/memory_budget.h"
#include "mesamis/files/number_type.h"
#include "mesamis/files/value_axes.h"
#include "mesamis/volume_files/chunk_codec.h"
#include "mesamis/volume_files/chunked_scan.h"

/// What Zarr and HDF5 share: an array in chunks, read as the slices of a scan.
namespace mesamis::detail::volume_files {

/// The layout of an array of three axes or more, the slowest first.
struct ChunkLayout {
  std::vector<std::uint64_t> shape;  ///< elements along each axis
  std::vector<std::uint64_t> chunk;  ///< elements of a chunk along each axis
  std::vector<std::size_t> order;    ///< axes of a chunk as stored, the slowest first
  NumberType type = NumberType::kUint8;
  ByteOrder byte_order = ByteOrder::kLittle;
  double fill = 0;  ///< of chunks that are missing
  std::vector<ChunkCodec> codecs;
  std::vector<std::uint64_t> lead{};  ///< which element of each axis before the last three is read
};

/// Checks a layout: numbers of axes, lengths, products. Chooses one element of each leading axis.
/// @param axes  names of the axes; may be empty.
/// @return voxels along i, j, k.
/// @throws InputError  naming the file; as take_value().
std::array<Index, 3> require_layout(const std::filesystem::path& file, ChunkLayout& layout,
                                    const std::vector<std::string>& axes = {},
                                    const ValueChoice& choice = {});

/// Names for a message: the first eight, and that there are more.
std::string first_of(const std::vector<std::string>& names);

/// Bytes of a chunk. @pre require_layout().
std::size_t chunk_bytes(const ChunkLayout& layout);

/// The bytes of one chunk as stored, and the steps that packed it.
struct StoredChunk {
  std::filesystem::path file;  ///< for messages
  std::string bytes;
  std::vector<ChunkCodec> codecs;
};

/// Fetches a chunk by its place among the chunks, one number per axis; none if it is missing. The
/// budget is asked for the bytes; who calls gives them back.
using FetchChunk =
    std::function<std::optional<StoredChunk>(const std::vector<std::uint64_t>&, MemoryBudget&)>;

/// What a scan in chunks is opened with.
struct OpenedArray {
  std::filesystem::path path;  ///< what messages begin with
  std::string format;
  VoxelGrid grid;
  std::vector<std::string> warnings;
  ChunkLayout layout;
  FetchChunk fetch;
  ReadLimits limits;
  std::shared_ptr<const std::vector<NamedNumber>> labels{};  ///< see ScaleLevel
};

/// Opens it. @throws InputError  if the spacing or the origin of the grid is not finite or
/// positive.
std::unique_ptr<ChunkedScan> make_chunked_scan(OpenedArray array);

/// The spacing that was asked for takes the place of the file's; a warning says so where they
/// differ. Without one asked for, it is that of the file, else 1 mm with a warning.
/// @throws InputError  naming the path, if the spacing asked for is not positive.
void set_spacing(OpenedArray& array, const std::optional<Vec3>& stated,
                 const std::optional<Vec3>& asked);

}  // namespace mesamis::detail::volume_files
