// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "mesamis/files/reading.h"
#include "mesamis/image/slice_source.h"

/// Scans that lie in chunks, of which only those are decoded that are asked for: Zarr and HDF5.
namespace mesamis::detail::volume_files {

struct ChunkOptions {
  /// Path of the array inside: "0", "/entry/data". Empty: the only 3D one; of OME-Zarr the finest.
  std::string dataset{};
  ReadLimits limits{};            ///< memory for chunks and for the slices of one read()
  std::optional<Vec3> spacing{};  ///< mm, positive, along i, j, k: taken instead of the file's
  /// From 0: where axes before the last three hold several times and channels, which is read.
  std::optional<Index> volume{}, channel{};
};

/// What an OME-Zarr image of labels tells about one of them.
struct NamedNumber {
  std::int64_t number = 0;
  std::string name;                                     ///< empty: not told
  std::optional<std::array<std::uint8_t, 3>> colour{};  ///< red, green, blue (sRGB)
};

/// A scan in chunks, open for reading.
///
/// The last axis of the array is i, the one before it j, then k. x runs to the left, y to the
/// back, z to the head. Axes of length 1 before these three are left out; of
/// longer ones, one called t (or the only one, or the first) holds volumes, another one channels.
/// Several threads may read at the same time; they wait for each other.
///
/// A read() decodes the chunks that the slices touch, each once. Where slices end within a chunk,
/// the row of chunks is kept for the next call if it takes at most a quarter of the memory allowed.
class ChunkedScan : public SliceSource {
 public:
  /// "Zarr", "OME-Zarr" or "HDF5".
  virtual const std::string& format() const = 0;
  /// One line each: what was assumed or replaced.
  virtual const std::vector<std::string>& warnings() const = 0;
  /// Whether its metadata call it an image of labels (OME-Zarr: image-label).
  virtual bool holds_labels() const = 0;
  /// The labels that these metadata name or colour, in their order.
  virtual const std::vector<NamedNumber>& named_numbers() const = 0;
  /// Hands the samples of all slices to visit(), block by block from the first voxel on, in double
  /// precision, which holds whole numbers to 2^53. Memory: a row of chunks at most.
  /// @throws InputError  as read(), and what visit() throws.
  virtual void visit_samples(const std::function<void(std::span<const double>)>& visit) const = 0;
};

/// Whether a path is a directory that holds a Zarr array or group (version 2 or 3), or leads to one
/// within it. O(length of the path) looks at the file system.
bool is_zarr(const std::filesystem::path& path) noexcept;

/// Whether a path is an HDF5 file, or leads on into one: "scan.h5/entry/data". O(length of the
/// path) looks at the file system.
bool is_hdf5(const std::filesystem::path& path) noexcept;

/// Opens an array of a Zarr store in a local directory.
///
/// Version 2, and version 3, also with shards. Numbers: whole ones of 8 to 64 bits, floating point
/// of 32 or 64, either byte order. Chunks in any order of axes, packed by zlib, gzip, Blosc or
/// Zstandard, shuffled, with CRC-32C. A chunk that is missing has the fill value (0 if there is
/// none). Groups with OME-Zarr multiscales (0.4, 0.5) give spacing and origin, in the units of
/// their axes; mm are taken where an axis has no unit. Other arrays get 1 mm. Warnings say so.
///
/// @param path     the store, or a group or an array within it: "scan.zarr/0".
/// @param options  see there.
/// @return grid in mm, LPS; samples in native units, in single precision.
/// @throws InputError  one line that begins with the path: what, where, expected, found.
///
/// O(groups) where the array is searched for. No chunk is read.
std::unique_ptr<ChunkedScan> open_zarr(const std::filesystem::path& path,
                                       const ChunkOptions& options = {});

/// Opens a dataset of an HDF5 file.
///
/// Whole numbers of 8 to 64 bits and floating point of 32 or 64, either byte order; contiguous, or
/// in chunks packed by deflate, Blosc or Zstandard, shuffled, with Fletcher-32. The spacing is the
/// attribute element_size_um of the dataset (micrometres along k, j, i), else 1 mm with a warning.
/// Datasets in other files (external links, external storage, virtual ones) are refused.
///
/// The HDF5 library keeps a state of its own in the process; its messages are turned off for the
/// time of a call.
///
/// @param path     the file, or a dataset within it: "scan.h5/entry/data".
/// @param options  see there.
/// @return grid in mm, LPS, the origin at voxel (0, 0, 0); samples in native units, in single
///         precision.
/// @throws InputError  one line that begins with the path: what, where, expected, found.
///
/// O(objects of the file) where the dataset is searched for. No sample is read.
std::unique_ptr<ChunkedScan> open_hdf5(const std::filesystem::path& path,
                                       const ChunkOptions& options = {});

}  // namespace mesamis::detail::volume_files
