// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>

#include "mesamis/image/slice_source.h"
#include "mesamis/volume_files/read_volume.h"

namespace mesamis::detail::volume_files {

/// The slices of a scan in files. Several threads may read at the same time.
class FileSlices : public SliceSource {
 public:
  /// What read_volume() returns of the same path, but for the samples, which are absent: grid,
  /// format, warnings, and the files that were opened.
  virtual const VolumeFile& head() const = 0;
};

/// Opens a scan whose slices can be read a few at a time; no sample is kept in memory.
///
/// These are .nii, .nrrd, .nhdr, .mha, .mhd and .inv3 whose voxels are not compressed and not in
/// text, raw files whose layout is given, .tif and .tiff page by page, whatever their compression,
/// and a directory of slices as .tif, .png or .bmp. DICOM cannot be read so.
///
/// Grid, samples and warnings, but for those of samples, have the bits of read_volume(), also with
/// options.spacing. Reading slices opens the files that hold them and reads these bytes alone; it
/// is refused where they are no longer in the state in which they were opened here.
///
/// @param path     file or directory, as for read_volume().
/// @param options  as for read_volume(); options.limits holds for each reading on its own, and
///                 options.on_grid is called once, here.
/// @return never null.
/// @throws InputError  one line that begins with the path: what, where, expected, found; also for
///                     a file that is shorter than its header says.
///
/// O(bytes) of the headers, for folders of PNG and BMP of whole files, one at a time.
std::unique_ptr<FileSlices> open_slices(const std::filesystem::path& path,
                                        const ReadOptions& options = {});

}  // namespace mesamis::detail::volume_files
