// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "mesamis/label_files/read_labels.h"
#include "mesamis/rooms.h"

namespace mesamis::detail::label_files {

/// Whether a Zarr store or a group in it calls itself an image of labels; not if it cannot be
/// opened.
bool holds_chunk_labels(const std::filesystem::path& path, const ReadLimits& limits);

/// Whether a Zarr store is an image that has labels in it.
bool has_labels_inside(const std::filesystem::path& path);

/// read_label_map() of a Zarr store or an HDF5 file. Of an OME-Zarr image that has labels in it,
/// they are read, not the image. Names and colours are those of the image-label of OME-Zarr.
/// @throws InputError  as open_zarr() and open_hdf5(), for several labels of an image, and for
///                     values that are none.
///
/// O(voxels). Memory: 2 bytes per voxel, and a row of chunks at a time.
LabelFile read_chunk_labels(const std::filesystem::path& path, const ReadLimits& limits);

}  // namespace mesamis::detail::label_files
