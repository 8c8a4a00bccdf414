// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "mesamis/files/byte_source.h"
#include "mesamis/files/memory_budget.h"
#include "mesamis/files/number_type.h"
#include "mesamis/image/grid_axes.h"
#include "mesamis/image/volume.h"
#include "mesamis/scan_files/slice_reader.h"

/// Shared by the readers of plain arrays (NIfTI, NRRD, MetaImage, InVesalius): a header is read
/// into a grid and the place and coding of the samples, and read_samples() reads them.
namespace mesamis::detail {

/// Where a file's samples lie and how they are coded. i runs fastest, then j, k.
struct SampleSource {
  std::filesystem::path file;
  NumberType type = NumberType::kInt16;
  bool big_endian = false;
  bool text = false;  ///< decimal numbers between white space
  Packing packing = Packing::kPlain;
  std::uint64_t offset = 0;         ///< bytes before the data in the file
  std::uint64_t skip = 0;           ///< bytes before the samples in the unpacked data
  bool at_end = false;              ///< the samples are the last bytes, whatever comes before
  bool exact = false;               ///< bytes after the samples are refused
  double slope = 1, intercept = 0;  ///< native value = slope * stored + intercept
};

/// A header that was read and checked.
struct ScanFile {
  std::filesystem::path file;
  std::string format;
  Volume grid;  ///< without samples
  SampleSource source;
  std::vector<std::string> warnings;
  Index inner = 1;                            ///< values per voxel, one after another
  Index outer = 1;                            ///< volumes, one after another
  std::map<std::string, std::string> keys{};  ///< NRRD: "key:=value"
};

/// How many values per voxel a reader accepts.
enum class Values { kOne, kMany };

/// What the reader of a header is given beside the path.
struct Opening {
  MemoryBudget& budget;
  bool allow_outside = false;  ///< see ReadLimits
  Values values = Values::kOne;
};

/// Sets the grid's size. @throws InputError  if a count is below 1 or the product out of bounds.
void set_size(ScanFile& scan, const std::array<std::int64_t, 3>& counts);

/// Sets the number of values per voxel; inner or outer is 1. Call it after set_size().
/// @throws InputError  if a count is below 1 or the number of samples out of bounds.
void set_values(ScanFile& scan, std::int64_t inner, std::int64_t outer);

/// Sets spacing and direction from one step along each axis (LPS, mm).
///
/// Axes whose cosines are below 1e-5 are made orthonormal; up to kSkewTolerance with a warning.
/// @throws InputError  for larger cosines, and a step of length 0 or that is not finite.
void set_axes(ScanFile& scan, const std::array<Vec3, 3>& steps);

/// Sets the origin. @throws InputError  if it is not finite.
void set_origin(ScanFile& scan, const Vec3& origin);

/// Reads the samples of all values, in the order of the file. A header that promises more than the
/// file can hold is refused before anything is claimed; then the samples are, and stay so.
/// @throws InputError  if the data are too short, broken or (source.exact) too long; as
///                     MemoryBudget::claim().
std::vector<float> read_samples(const ScanFile& scan, MemoryBudget& budget);

/// Reads the samples of all values in double precision, which holds whole numbers to 2^53, and hands
/// them to visit() block by block, in the order of the file. Memory: one block.
/// @throws InputError  as read_samples(), and what visit() throws.
void visit_samples(const ScanFile& scan,
                   const std::function<void(std::span<const double>)>& visit);

/// Where the samples begin in source.file, in bytes, if they lie there as they are. The header is
/// held against the size of the file; no sample is read.
/// @throws InputError  if they are compressed or in text; as read_samples().
std::uint64_t find_plain_samples(const ScanFile& scan);

/// Appends the samples of some slices; no other is read.
/// @param begin  from find_plain_samples().
/// @throws InputError  if the file ends before them.
void append_slices(const ScanFile& scan, std::uint64_t begin, const SliceRange& slices,
                   std::vector<float>& out);

/// Appends stored samples to `out` as native values.
/// @param bytes  a whole number of samples.
void append_samples(std::span<const unsigned char> bytes, const SampleSource& source,
                    std::vector<float>& out);

}  // namespace mesamis::detail
