// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "mesamis/base/error.h"
#include "mesamis/files/byte_source.h"
#include "mesamis/files/memory_budget.h"
#include "mesamis/files/number_type.h"
#include "mesamis/files/value_axes.h"
#include "mesamis/image/grid_axes.h"
#include "mesamis/image/volume.h"
#include "mesamis/volume_files/slice_reader.h"

/// Shared by the readers of plain arrays (NIfTI, NRRD, MetaImage, InVesalius): a header is read
/// into a grid and the place and coding of the samples, and read_samples() reads them.
namespace mesamis::detail::volume_files {

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

/// The one value of each voxel that is read, where a file has more.
struct PickedValue {
  Index inner = 0, outer = 0;  ///< see ScanFile
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
  std::optional<PickedValue> picked{};        ///< none: all values are read
  std::map<std::string, std::string> keys{};  ///< NRRD: "key:=value"
  std::optional<Vec3> given_spacing{};        ///< mm: for what the file lacks, see begin_scan()
  bool resample = false;                      ///< sheared axes are taken, see set_stated_axes()
  /// Steps along the axes of a grid that is to be resampled, LPS, mm.
  std::optional<std::array<Vec3, 3>> sheared{};
  /// The samples lie in these files in turn, with equal numbers of slices, or one volume each.
  std::vector<std::filesystem::path> parts{};
  /// Red, green and blue of a picture's values, where these are the indices of its table of
  /// colours.
  std::vector<std::array<std::uint8_t, 3>> palette{};
};

/// How many values per voxel a reader accepts.
enum class Values { kOne, kMany };

/// What the reader of a header is given beside the path.
struct Opening {
  MemoryBudget& budget;
  bool allow_outside = false;  ///< see ReadLimits
  Values values = Values::kOne;
  std::optional<Vec3> spacing{};  ///< mm, given by the user
  bool resample = false;          ///< see ReadOptions
  ValueChoice choice{};           ///< of Values::kOne
  /// The values are labels. Of pictures with a table of colours they are its indices; lossy
  /// pictures are refused.
  bool labels = false;
};

/// How a file places its voxels: directions and distances may each be missing or unusable.
struct StatedAxes {
  std::array<Vec3, 3> direction{};  ///< LPS; of any length, 0 where it is not known
  Vec3 spacing{};                   ///< mm

  /// Of steps from voxel to voxel along each axis, LPS, mm.
  static StatedAxes of_steps(const std::array<Vec3, 3>& steps) noexcept;
};

/// A scan whose header is about to be read.
/// @param format  as VolumeFile::format.
ScanFile begin_scan(const std::filesystem::path& file, const std::string& format,
                    const Opening& opening);

/// Sets the grid's size. @throws InputError  if a count is below 1 or the product out of bounds.
void set_size(ScanFile& scan, const std::array<std::int64_t, 3>& counts);

/// Where the values of a voxel lie.
enum class ValueOrder {
  kChannelsFirst,  ///< the channels of a voxel one after another, then the voxels, the volumes
  kVolumesFirst,   ///< all voxels of a volume, then the volumes, then the channels
};

/// Sets the number of values per voxel and, for Values::kOne, which of them is read. Call it after
/// set_size().
/// @throws InputError  if a count is below 1 or the number of samples out of bounds; as
///                     take_value(); for Values::kMany, if there are volumes and channels.
void set_values(ScanFile& scan, const ValueAxes& axes, ValueOrder order, const Opening& opening);

/// Sets spacing and direction.
///
/// Axes whose cosines are below 1e-5 are made orthonormal; up to kSkewTolerance with a warning.
/// A spacing that is not positive and finite, and a missing direction, are replaced by
/// scan.given_spacing and the direction across the others, with a warning, if a spacing is given.
/// Axes of larger cosines are kept in scan.sheared if scan.resample; the grid then has no
/// direction.
/// @throws InputError  for larger cosines, and a spacing or direction that cannot be used.
void set_stated_axes(ScanFile& scan, const StatedAxes& axes);
/// The same of one step along each axis, LPS, mm.
void set_axes(ScanFile& scan, const std::array<Vec3, 3>& steps);

/// What a file states, or, where a spacing is given and the file's text cannot be read, a fallback
/// with a warning.
/// @param read  returns it; throws InputError.
template <class Read, class Stated>
Stated stated_or(ScanFile& scan, const Read& read, const Stated& fallback) {
  try {
    return read();
  } catch (const InputError& error) {
    if (!scan.given_spacing) {
      throw InputError(std::string(error.what()) + " (--spacing X,Y,Z replaces it)");
    }
    scan.warnings.push_back(error.what());
    return fallback;
  }
}

/// Sets the origin. @throws InputError  if it is not finite.
void set_origin(ScanFile& scan, const Vec3& origin);

/// Adds a warning where at least one slice more lies behind the samples of one plain file than the
/// header states. Of packed ones the end is not known. Call it when the source is set.
void warn_of_bytes_behind(ScanFile& scan);

/// Reads the samples: of the value that is picked, or of all values, in the order of the file. A
/// header that promises more than the file can hold is refused before anything is claimed; then the
/// samples are, and stay so.
/// @throws InputError  if the data are too short, broken or (source.exact) too long; as
///                     MemoryBudget::claim().
std::vector<float> read_samples(const ScanFile& scan, MemoryBudget& budget);

/// Reads the samples of all values in double precision, which holds whole numbers to 2^53, and
/// hands them to visit() block by block, in the order of the file. Memory: one block.
/// @throws InputError  as read_samples(), and what visit() throws.
void visit_samples(const ScanFile& scan, const std::function<void(std::span<const double>)>& visit);

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
/// In double precision, which holds whole numbers to 2^53.
void append_samples(std::span<const unsigned char> bytes, const SampleSource& source,
                    std::vector<double>& out);

}  // namespace mesamis::detail::volume_files
