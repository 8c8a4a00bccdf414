// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "mesamis/files/reading.h"
#include "mesamis/image/volume.h"

namespace mesamis {

/// How the samples of a raw file are stored.
enum class RawType { kUint8, kInt16, kUint16, kInt32, kFloat32, kFloat64 };

/// The layout of a raw file: a header that is skipped, then the samples, i fastest, then j, k.
struct RawLayout {
  std::array<std::int64_t, 3> size{0, 0, 0};  ///< voxels
  RawType type = RawType::kInt16;
  bool big_endian = false;
  std::int64_t header_bytes = 0;
};

/// Reads "NX,NY,NZ,TYPE" or "NX,NY,NZ,TYPE,HEADERBYTES": TYPE is uint8, int16, uint16, int32,
/// float32 or float64, with le (default) or be behind it for the byte order.
/// @return voxels and bytes.
/// @throws InputError  for any other text.
RawLayout parse_raw_layout(std::string_view text);

struct ReadOptions {
  std::string series{};  ///< DICOM: UID of the series to take; empty: the only volume there is
  /// The path is a raw file of this layout, whatever its extension.
  std::optional<RawLayout> raw{};
  std::optional<Vec3> spacing{};   ///< mm, positive: replaces the file's
  bool resample = false;           ///< interpolate stacks that are no regular grid
  std::optional<Index> volume{};   ///< from 0: which one of a 4-D file or a series of phases
  std::optional<Index> channel{};  ///< from 0: which one of the values of each voxel
  std::string modality{};          ///< "CT", "MR" or "other": replaces the file's
  ReadLimits limits{};             ///< memory, and other folders
  /// Called with the grid after the headers and before the samples are read. It may throw, for
  /// example for lack of memory. list_volumes() does not call it.
  std::function<void(const VoxelGrid&)> on_grid{};
};

/// A volume and the other contents of its file.
struct VolumeFile {
  Volume volume;  ///< samples in native units (HU for CT); spacing and origin in mm, LPS
  /// "NIfTI", "NRRD", "MetaImage", "TIFF", "PNG", "BMP", "DICOM", "InVesalius", "raw"; of a folder
  /// of pictures "TIFF slices", "PNG slices", "BMP slices"
  std::string format;
  std::vector<std::string> warnings;  ///< one line each: what was assumed, left out or damaged
  std::vector<ReadFile> files{};      ///< all files opened, in the order of their paths
};

/// Reads a 3D scan: .nii .nii.gz .nrrd .nhdr .mha .mhd .tif .tiff .inv3, a DICOM directory (and
/// those below it), one file of a DICOM series (the rest is taken from its directory), a directory
/// of slices as .tif, .png or .bmp, or a raw file whose layout is given.
///
/// Slices are pictures of one format, size and type, one per file, in the order of the numbers in
/// their names ("s9" before "s10"); they count where a directory holds no DICOM. x runs to the
/// left, y to the back, z to the head; spacing along x and y from the pictures' resolution, 1 mm
/// between slices, with warnings. A .png or .bmp alone is one slice. Colours are refused, unless
/// all of them are grey. A raw file must have the size of its layout to the byte.
///
/// The world frame is LPS, whatever the file's. Where a file states no orientation, a warning says
/// what was assumed. NIfTI: the sform if its code is above 0, else the qform. InVesalius: x to the
/// left, y to the front, z to the head, first voxel at the origin. TIFF: x to the left, y to the
/// back; spacing from its resolution tags and ImageJ's description, else 1 mm with a warning. Axes
/// that are orthogonal to a cosine of 1e-3 are made orthonormal, with a warning above 1e-5; beyond
/// that the file is refused.
///
/// DICOM: slices are grouped by series, size and orientation and sorted along their normal; each is
/// rescaled by its own slope and intercept. Localizers are left out with a warning: frames marked
/// as such, and a stack across the main one that is single or at most a quarter of it. Refused are
/// several series (unless one is named or only one is a stack), slice distances that differ by more
/// than 2 %, missing slices, two slices at one place, tilted stacks, broken files of the series. A
/// file that cannot be opened is left out with a warning. A single slice is no volume, because its
/// thickness is not stated. JPEG data that are corrupt but can be decoded are read with a warning.
///
/// Volumes that no method can use (a single slice of a 3D format, NaN, a constant) are read;
/// require_usable() refuses them before a method runs.
///
/// With options.resample a DICOM stack with a tilted gantry, uneven or missing slices is brought
/// onto a regular grid instead of being refused: shifted back within the slices, planes as far
/// apart as the nearest two slices (a quarter of the median distance at least), linear in between.
/// Warnings say what was done, and how far a plane is from a slice. Voxels that no slice covers get
/// the least value.
///
/// Nothing is printed, and no state of the process is changed, with one exception: gdcm::Trace is
/// off while JPEG-LS or JPEG 2000 is decoded, and restored afterwards. Several threads may read at
/// the same time.
///
/// @param path     file or directory; the extension decides, DICOM is known by its content.
/// @param options  which DICOM series to take, a raw file's layout, another spacing.
/// @return finite grid; one sample per voxel in native units (rescale slope and intercept
///         applied), in single precision: integers of more than 24 bits are rounded. A warning says
///         where that takes more than a 4096th of their range.
/// @throws InputError  one line that begins with the path: what, where, expected, found. Also where
///                     single precision leaves one value of samples that differ, or has none.
///
/// O(voxels) and, for DICOM, the bytes of all files below the directory. Memory: 4 bytes per voxel,
/// and one file of the series or one page at a time. What a header claims beyond what its file can
/// hold, or beyond options.limits, is refused before it is taken.
VolumeFile read_volume(const std::filesystem::path& path, const ReadOptions& options = {});

/// Reads the grid of a scan from its headers: the one that read_volume() passes to options.on_grid.
/// @return finite grid, mm, LPS.
/// @throws InputError  as read_volume(), except for errors in the samples.
///
/// O(bytes) of the headers; pictures and DICOM as list_volumes().
VoxelGrid read_grid(const std::filesystem::path& path, const ReadOptions& options = {});

/// A volume found at a path, as `mesamis info` lists it.
struct VolumeInfo {
  std::string series;                   ///< DICOM series UID, else empty
  std::string description;              ///< series description or file name
  std::string format, modality;         ///< as VolumeFile::format; "CT", "MR", else empty
  std::array<Index, 3> size{0, 0, 0};   ///< voxels
  Vec3 spacing;                         ///< mm
  std::string problem;                  ///< why read_volume() refuses it; empty if it does not
  Vec3 origin{};                        ///< LPS, mm; see VoxelGrid::origin
  Mat3 direction{};                     ///< LPS; see VoxelGrid::direction
  std::vector<std::string> warnings{};  ///< those of VolumeFile that the headers give
};

/// Lists the volumes of a file or directory without decoding the samples: the DICOM series (of a
/// directory and those below it, or of the directory a DICOM file lies in), then the volume files
/// of the directory itself, in name order.
///
/// A directory of slices is one volume.
///
/// @param path     file or directory.
/// @param options  as for read_volume().
/// @return at least one entry; a volume that read_volume() would refuse has a `problem`.
/// @throws InputError  if the path does not exist or holds nothing that can be read.
///
/// O(bytes) of the headers, for DICOM, PNG and BMP of whole files; memory: one file at a time.
std::vector<VolumeInfo> list_volumes(const std::filesystem::path& path,
                                     const ReadOptions& options = {});

}  // namespace mesamis
