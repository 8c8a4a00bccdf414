// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "mesamis/image/volume.h"
#include "mesamis/volume_files/dicom_pixels.h"

namespace mesamis::detail::label_files {

/// The grid on which the frames of a DICOM segmentation lie.
struct SegGrid {
  VoxelGrid grid;
  std::vector<Index> slice;  ///< k of each frame
};

/// Finds the grid from the positions of the frames; some frames may share a position, and positions
/// without a frame may lie between others.
///
/// The step between slices is the Spacing Between Slices, if all positions fit it, else the least
/// distance of two positions; of a single position the Spacing Between Slices or the Slice
/// Thickness.
/// @param pixels  pixels_of(file).
/// @throws InputError  naming the frame and both values, for frames of different orientation or
///                     pixel spacing or that are not straight above one another, for positions that
///                     do not fit a regular grid to 2 % of its step, and if the grid has too many
///                     voxels for the file.
///
/// O(frames), up to a logarithm.
SegGrid grid_of_frames(const DicomFile& file, const DicomPixels& pixels);

/// Checks that a file may have so many voxels in its layers: most of them may be missing in the
/// file, but a small file must not ask for all memory.
/// @throws InputError  if they are more than 8192 per byte of the file.
void require_voxels(const DicomFile& file, const VoxelGrid& grid, std::size_t layers);

}  // namespace mesamis::detail::label_files
