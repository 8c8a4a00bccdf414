// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "mesamis/volume_files/read_volume.h"
#include "mesamis/volume_files/scan_file.h"

/// The formats of this room, one .cpp each. Every function throws InputError, one line, and asks
/// the budget before it takes memory whose amount a file decides.
namespace mesamis::detail::volume_files {

/// A header, and how to read the samples of some slices.
struct OpenSlices {
  ScanFile scan;
  SliceReader read;
};

/// NIfTI-1 and -2, one file or .hdr and .img, plain or gzip'd, either byte order; Analyze 7.5,
/// whose axes are taken as LAS with a warning. World frame: the sform if its code is above 0, else
/// the qform, else (with a warning) method 1 of the standard: axes along RAS, origin 0. RAS is
/// turned into LPS; lengths in m or um into mm. Of many values the fourth or the fifth axis may
/// hold more than one volume.
ScanFile open_nifti(const std::filesystem::path& file, const Opening& opening);

/// The header extensions of a NIfTI file, without size and code: none if there are none.
/// @throws InputError  also for an extension of more than 16 MiB, or that ends behind the header.
std::vector<std::string> nifti_extensions(const std::filesystem::path& file, MemoryBudget& budget);

/// NRRD 1 to 5 with 3 domain axes; raw, gzip or ascii; attached or one detached data file.
/// World frame: spaces in LPS, RAS or LAS order; without a space the axes are taken as LPS.
/// Of many values the first or the last of four axes may be a list.
ScanFile open_nrrd(const std::filesystem::path& file, const Opening& opening);

/// MetaImage with 3 axes and one channel; raw, zlib or ascii; LOCAL or one data file. LPS.
ScanFile open_meta(const std::filesystem::path& file, const Opening& opening);

/// InVesalius project: a tar (gzip'd or not) with main.plist and the matrix it names. The project
/// stores x to the left, y to the front and z to the head (checked on the distribution's
/// Cranium.inv3; the file itself does not say), and no origin: the first voxel is put at 0.
ScanFile open_inv3(const std::filesystem::path& file, const Opening& opening);

/// FreeSurfer's .mgh, and .mgz in gzip: RAS, turned into LPS; several frames are volumes.
ScanFile open_mgh(const std::filesystem::path& file, const Opening& opening);

/// Scanco's .isq: 16 bits, values as stored, axes taken as LPS, origin 0.
ScanFile open_isq(const std::filesystem::path& file, const Opening& opening);

/// Scanco's .aim of versions 020 and 030, uncompressed; values as stored, axes taken as LPS, origin
/// as the file has it.
ScanFile open_aim(const std::filesystem::path& file, const Opening& opening);

/// VGSTUDIO's .vgi, or the .vol beside it: one file of bare samples; axes taken as LPS, origin 0.
ScanFile open_vgi(const std::filesystem::path& file, const Opening& opening);

/// Opens one of the formats above, as the file's name says; none for any other name.
std::optional<ScanFile> open_array(const std::filesystem::path& file, const Opening& opening);

/// Whether open_array() opens a file of this name.
bool is_array_file(const std::filesystem::path& file);

/// A file of bare samples, i fastest, then j, k; 1 mm with a warning, axes LPS, origin 0. The size
/// of the file must be the layout's to the byte.
ScanFile open_raw(const std::filesystem::path& file, const RawLayout& layout);

/// A TIFF whose pages are the slices; x to the left, y to the back, z to the head. Spacing from
/// the resolution tags and from ImageJ's description (unit, spacing), 1 mm with a warning else.
VolumeFile read_tiff(const std::filesystem::path& file, const Opening& opening);
ScanFile open_tiff_header(const std::filesystem::path& file, const Opening& opening);
OpenSlices open_tiff_slices(const std::filesystem::path& file, const Opening& opening);

/// Takes samples, of one slice or more, in double precision.
using VisitSamples = std::function<void(std::span<const double>)>;

/// The slices of a TIFF, one after another.
void visit_tiff(const std::filesystem::path& file, const Opening& opening,
                const VisitSamples& visit);

/// A PNG, one slice as above; 1 to 16 bits, grey, or colours that are. Spacing along x and y from
/// its resolution (pHYs). Not interlaced. What it claims is compared with its bytes before memory
/// is taken for it. Labels (Opening::labels) are the indices of a table of colours, if it has one.
VolumeFile read_png(const std::filesystem::path& file, const Opening& opening);
ScanFile open_png(const std::filesystem::path& file, const Opening& opening);

/// An uncompressed BMP of 1, 4, 8, 24 or 32 bits, as a PNG.
VolumeFile read_bmp(const std::filesystem::path& file, const Opening& opening);
ScanFile open_bmp(const std::filesystem::path& file, const Opening& opening);

/// A grey JPEG, as a PNG, with a warning: it is lossy. It holds no labels.
VolumeFile read_jpeg(const std::filesystem::path& file, const Opening& opening);
ScanFile open_jpeg(const std::filesystem::path& file, const Opening& opening);

/// Whether the file's name is that of a picture: .tif .tiff .png .bmp .jpg .jpeg.
bool is_picture(const std::filesystem::path& file);
/// One of them, as the name says.
VolumeFile read_picture(const std::filesystem::path& file, const Opening& opening);
/// The same in double precision, which holds whole numbers to 2^53: its slices one after another.
void visit_picture(const std::filesystem::path& file, const Opening& opening,
                   const VisitSamples& visit);
/// Its grid and the type of its samples; they are not read.
ScanFile open_picture(const std::filesystem::path& file, const Opening& opening);
/// The same, and how to read its slices: of a .tif some of its pages, else the one slice.
OpenSlices open_picture_slices(const std::filesystem::path& file, const Opening& opening);

/// Refuses a file of no format that is read.
[[noreturn]] void refuse_unknown(const std::filesystem::path& file);

/// @throws InputError  for a spacing or a modality that was asked for and is none.
void require_options(const std::filesystem::path& path, const ReadOptions& options);
/// What a reader of headers is given.
Opening opening_of(const ReadOptions& options, MemoryBudget& budget);
/// The spacing, see apply_spacing(), and the modality that were asked for, if any were, take the
/// place of the file's.
void apply_options(const ReadOptions& options, VolumeFile& file);

/// Removes the warnings of a spacing that was assumed or is doubtful, for one that is known better.
/// @return how many told that it was assumed.
std::size_t drop_spacing_warnings(std::vector<std::string>& warnings);

/// The spacing that was asked for, if any, takes the place of a grid's, with a warning, and also of
/// what was assumed.
/// @param warnings  of the grid's file.
void apply_spacing(const std::optional<Vec3>& spacing, VoxelGrid& grid,
                   std::vector<std::string>& warnings);

/// Tells the caller of the grid whose samples are about to be read, with the spacing and the
/// modality that were asked for.
/// @throws InputError  as options.on_grid.
void announce(VoxelGrid grid, const ReadOptions& options);

/// Takes over size, spacing, origin and direction of a grid.
void set_grid(VolumeInfo& info, const VoxelGrid& grid);

/// One DICOM series: of a directory and those below it, or the one a file belongs to.
/// Files that cannot be opened are left out with a warning.
VolumeFile read_dicom(const std::filesystem::path& path, const ReadOptions& options,
                      MemoryBudget& budget);
std::vector<VolumeInfo> list_dicom(const std::filesystem::path& path, const ReadOptions& options,
                                   MemoryBudget& budget);
/// Whether the file begins like DICOM, with or without the preamble; not if it cannot be opened.
bool looks_like_dicom(const std::filesystem::path& file);

}  // namespace mesamis::detail::volume_files
